#include "engine/probe.hpp"

#include "core/temporary_folder.hpp"
#include "deck/check.hpp"
#include "deck/deck.hpp"
#include "engine/certificate_cache.hpp"
#include "engine/probe_decks.hpp"
#include "engine/probe_verdicts.hpp"
#include "engine/three_grains.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include <fmt/format.h>
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
    Names failed = failed_by("sed -i 's/gravity 9.81/gravity 9.7/' in.liggghts");
    for (double const ratio : deck::probed_size_ratios)
        EXPECT_EQ(failed.erase(fmt::format("three-grains-roll-{}", ratio)), 1u) << ratio;
    EXPECT_EQ(failed, (Names{"sliding", "rolling"}));
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

// phi'' = rate sin(phi) from rest, integrated in steps of time as a second way to the same number; 1e-5 is
// the error of 20,000 leapfrog steps and of the last, whole step.
TEST(ThreeGrains, RollingTimeIsThatOfTheEquationOfMotion) {
    GapRoll const roll;
    for (double const ratio : deck::probed_size_ratios) {
        double const r = roll.small_diameter / 2, large = ratio * r;
        double const distance = std::sqrt(std::pow(large + r, 2) - large * large);
        double const rate = 9.81 / (distance * (1 + 0.4 * std::pow((large + r) / distance, 2)));
        double const step = rolling_time(roll, ratio) / 20000;
        double angle = roll.start_angle, speed = 0;
        for (int i = 0; i < 20000; ++i) {
            speed += step / 2 * rate * std::sin(angle);
            angle += step * speed;
            speed += step / 2 * rate * std::sin(angle);
        }
        EXPECT_NEAR(angle, roll.end_angle, 1e-5) << ratio;
    }
}

// A grain that small sticks when rolling is suppressed, or when friction is: neither rolls in time.
TEST_F(Probe, SmallGrainsThatDoNotRoll) {
    Names const sliding = failed_by(
        "case $PWD in */three-grains-roll) sed -i '/^fix friction/s/0.5/0.01/g' in.liggghts;; esac");
    EXPECT_TRUE(sliding.contains("three-grains-roll-1"));
    EXPECT_TRUE(sliding.contains("three-grains-roll-20"));
    EXPECT_FALSE(sliding.contains("three-grains-held"));
    Names const turned = failed_by(
        "case $PWD in */three-grains-roll) sed -i 's/small nve.sphere/small nve/' in.liggghts;; esac");
    EXPECT_TRUE(turned.contains("three-grains-roll-3")) << "a grain that cannot turn is stopped by friction";
}

// A friction 5 % too large holds the grains that should be expelled, one 5 % too small expels the others:
// the limit of 26.6 degrees moves by 1.1 degrees, the groups are 1 degree from it.
TEST_F(Probe, SmallGrainsThatGetCaught) {
    std::string const change =
        "case $PWD in */three-grains-nip) sed -i '/^fix friction/s/0.5/{}/g' in.liggghts;; esac";
    EXPECT_EQ(failed_by(fmt::format(fmt::runtime(change), 0.53)), Names{"three-grains-expelled"});
    EXPECT_EQ(failed_by(fmt::format(fmt::runtime(change), 0.47)), Names{"three-grains-held"});
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
    for (ProbeDeck const& probe : {gap_roll_deck(), nip_deck()}) {
        EXPECT_NE(probe.files.at("in.liggghts")
                      .find("gran model hertz tangential history limitForce on tangential_damping off\n"),
                  std::string::npos)
            << probe.name << " has grains without a trough";
    }
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

// A grain that only rotates after its impact, and has all of the energy: a solid sphere with 2/5 m R^2.
TEST_F(Probe, TheEnergyOfAnImpactHoldsThatOfRotation) {
    auto const& impacts = fine_impacts();
    double const radius = probe_material(0.5, impact_friction).radius;
    std::ofstream file(folder / "grains.dump");
    for (int time = 0; time < 2; ++time) {
        file << "ITEM: ATOMS\n";
        for (std::size_t i = 0; i < impacts.size(); ++i) {
            double const speed = std::hypot(impacts[i].normal_speed, impacts[i].tangential_speed);
            file << fmt::format("{} 0 0 0 0 {}\n", i + 1, std::sqrt(5.0 / 2) * speed / radius);
        }
    }
    file.close();
    auto const probes = judge_fine_impacts(folder, "");
    auto const energy = std::ranges::find(probes, "energy", &ProbeResult::name);
    ASSERT_NE(energy, probes.end());
    EXPECT_NEAR(energy->measured, 1, 1e-12);
}

}  // namespace
}  // namespace vibrotrough::engine
