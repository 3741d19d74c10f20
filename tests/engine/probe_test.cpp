#include "engine/probe.hpp"

#include "core/temporary_folder.hpp"
#include "deck/deck.hpp"
#include "engine/certificate_cache.hpp"
#include "engine/probe_decks.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <filesystem>
#include <fstream>
#include <set>

#include <gtest/gtest.h>
#include <sys/resource.h>

namespace vibrotrough::engine {
namespace {

namespace fs = std::filesystem;

/// CPU time of all child processes that have ended, s.
double cpu_time_of_children() {
    rusage usage{};
    ::getrusage(RUSAGE_CHILDREN, &usage);
    auto const seconds = [](timeval const& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// These tests probe the real LIGGGHTS, and scripts that alter the decks before they start it.
class Probe : public testing::Test {
  protected:
    static Certificate certificate_of(Engine const& engine) {
        return probe_engine(engine, identify(engine)).value();
    }

    /// The names of the probes that fail for an engine that first runs `commands` in the folder of the deck.
    std::set<std::string> failed_by(std::string const& commands) {
        Engine const real = find_engine({});
        fs::path const script = folder / "script";
        std::ofstream(script) << "#!/bin/sh\n"
                              << commands << "\nexec " << real.program.string() << " \"$@\"\n";
        fs::permissions(script, fs::perms::owner_all);
        std::set<std::string> names;
        for (ProbeResult const& probe : certificate_of({script, real.version}).probes)
            if (!probe.passed()) names.insert(probe.name);
        return names;
    }

    core::TemporaryFolder const own_folder;
    fs::path folder = own_folder.path();
};

using Names = std::set<std::string>;

TEST_F(Probe, TheRealEnginePasses) {
    double const before = cpu_time_of_children();
    Certificate const certificate = certificate_of(find_engine({}));
    double const spent = cpu_time_of_children() - before;
    for (ProbeResult const& probe : certificate.probes) {
        EXPECT_TRUE(probe.passed()) << probe.name << ": " << probe.measured << " " << probe.problem;
        for (std::string const* text : {&probe.question, &probe.source, &probe.tolerance_reason, &probe.unit})
            EXPECT_FALSE(text->empty()) << probe.name;
    }
    EXPECT_TRUE(certificate.passed());
    EXPECT_EQ(certificate.speed_grains, 1008);
    // The speed is measured over 4000 steps. They took part of the time that all probes took here: not more
    // than all of it, and not less than a hundredth.
    double const time_of_speed = 1008 * 4000 / certificate.grain_steps_per_cpu_second;
    EXPECT_LT(time_of_speed, spent);
    EXPECT_GT(time_of_speed, 0.01 * spent);
}

TEST_F(Probe, DefaultContactOptionsAreNotCoulombs) {
    Names const failed = failed_by("sed -i 's/ tangential_damping off//' in.liggghts");
    EXPECT_TRUE(failed.contains("coulomb"));
    EXPECT_TRUE(failed.contains("coulomb-at-longest-step"));
    EXPECT_FALSE(failed.contains("restitution-0.5"));
    EXPECT_FALSE(failed.contains("drive"));
}

TEST_F(Probe, AttractiveNormalForces) {
    Names const failed = failed_by("sed -i 's/ limitForce on//' in.liggghts");
    EXPECT_TRUE(failed.contains("restitution-0.1"));
    EXPECT_FALSE(failed.contains("energy"));
    EXPECT_FALSE(failed.contains("weight-least"));
}

TEST_F(Probe, WrongGravity) {
    EXPECT_EQ(failed_by("sed -i 's/gravity 9.81/gravity 9.7/' in.liggghts"), (Names{"sliding", "rolling"}));
}

TEST_F(Probe, WrongFriction) {
    Names const failed = failed_by("sed -i '/^fix friction/s/0.23/0.26/g' in.liggghts");
    EXPECT_TRUE(failed.contains("coulomb"));
    EXPECT_TRUE(failed.contains("sliding"));
    EXPECT_FALSE(failed.contains("restitution-0.1"));
}

// LIGGGHTS' `wiggle` sums A omega cos(omega t) dt and is wrong by 1.3 % at 500 steps per cycle.
TEST_F(Probe, WrongMover) {
    EXPECT_EQ(failed_by("case $PWD in */drive) sed -i 's/linear.variable .*/wiggle amplitude 0.0052 0 0.003 "
                        "period 0.05/' in.liggghts;; esac"),
              Names{"drive"});
}

// A mesh that extends beyond the periodic faces overlaps its own image.
TEST_F(Probe, ContactsThatCountTwice) {
    Names const failed = failed_by("sed -i 's/vertex 0.036 /vertex 0.045 /' trough.stl");
    EXPECT_TRUE(failed.contains("weight-most"));
    EXPECT_FALSE(failed.contains("sliding"));
}

TEST_F(Probe, AnEngineThatBreaksFailsWithItsMessage) {
    Engine const real = find_engine({});
    EXPECT_EQ(failed_by("exit 7").size(), certificate_of(real).probes.size());
    EXPECT_EQ(failed_by("case $PWD in */incline) echo 'ERROR: no such thing'; exit 1;; esac"),
              (Names{"sticking", "sliding", "rolling"}));
    EXPECT_EQ(failed_by("case $PWD in */incline) exit 0;; esac"), (Names{"sticking", "sliding", "rolling"}));
}

TEST_F(Probe, AnEngineThatLosesItsOutputFails) {
    EXPECT_EQ(failed_by("case $PWD in */drive) echo VIBROTROUGH DONE step 500 grains 1; exit 0;; esac"),
              Names{"drive"});
}

// The probes are meaningful only if campaigns use the same contact options.
TEST_F(Probe, TheDecksUseWhatIsProbed) {
    scenario::Scenario const scenario = scenario::parse_campaign(example_campaign, "test.toml").cases.front();
    std::string const campaign =
        deck::make_deck(prepare::prepare_case(scenario), {1}).files.at("in.liggghts");
    for (ProbeDeck const& probe : {fine_impact_deck(), coarse_impact_deck(), incline_deck(), contact_deck(),
                                   drive_deck(), speed_deck(1)}) {
        for (std::string const& text : {campaign, probe.files.at("in.liggghts")}) {
            EXPECT_NE(text.find("gran model hertz tangential history limitForce on tangential_damping off\n"),
                      std::string::npos)
                << probe.name;
            EXPECT_NE(
                text.find("wall/gran model hertz tangential history mesh n_meshes 1 meshes trough limitForce "
                          "on tangential_damping off\n"),
                std::string::npos)
                << probe.name;
        }
    }
}

}  // namespace
}  // namespace vibrotrough::engine
