#include "engine/probe.hpp"

#include "core/temporary_folder.hpp"
#include "deck/deck.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace vibrotrough::engine {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

// These tests probe the real LIGGGHTS, and scripts that alter the deck before they start it.
class Probe : public testing::Test {
  protected:
    static Certificate certificate_of(Engine engine) {
        EngineIdentity const identity = identify(engine);
        return probe_engine(engine, identity).value();
    }

    /// The certificate of an engine that first runs `commands` in the folder of the deck.
    Certificate certificate_after(std::string const& commands) const {
        Engine const real = find_engine({});
        fs::path const script = folder.path() / "script";
        std::ofstream(script) << "#!/bin/sh\n"
                              << commands << "\nexec " << real.program.string() << " \"$@\"\n";
        fs::permissions(script, fs::perms::owner_all);
        return certificate_of({script, real.version});
    }

    Names failed_by(std::string const& commands) const {
        Names names;
        for (ProbeResult const& probe : certificate_after(commands).probes)
            if (!probe.passed()) names.insert(probe.name);
        return names;
    }

    core::TemporaryFolder const folder;
};

TEST_F(Probe, TheRealEnginePasses) {
    Certificate const certificate = certificate_of(find_engine({}));
    for (ProbeResult const& probe : certificate.probes)
        EXPECT_TRUE(probe.passed()) << probe.name << ": " << probe.measured;
    EXPECT_EQ(certificate.probes.size(), 7u);
    EXPECT_TRUE(certificate.passed());
}

TEST_F(Probe, DefaultContactOptionsAreNotCoulombs) {
    EXPECT_EQ(failed_by("sed -i 's/ tangential_damping off//' in.liggghts"),
              (Names{"coulomb", "oblique-impulse"}));
}

TEST_F(Probe, AttractiveNormalForces) {
    Names const failed = failed_by("sed -i 's/ limitForce on//' in.liggghts");
    EXPECT_TRUE(failed.contains("restitution-0.1"));
    EXPECT_FALSE(failed.contains("restitution-0.9"));
}

TEST_F(Probe, WrongFriction) {
    EXPECT_EQ(failed_by("sed -i '/^fix friction/s/0.23/0.26/g' in.liggghts"),
              (Names{"coulomb", "oblique-impulse"}));
}

TEST_F(Probe, AnEngineThatBreaksFailsWithItsMessage) {
    for (auto const& [commands, words] : {std::pair{"echo 'nonsense' >> in.liggghts", "Unknown command"},
                                          std::pair{"sed -i /DONE/d in.liggghts", "end marker"},
                                          std::pair{"sed -i /^dump/d in.liggghts", "grains.dump"}}) {
        Certificate const certificate = certificate_after(commands);
        EXPECT_FALSE(certificate.passed());
        EXPECT_NE(certificate.problem.find(words), std::string::npos) << certificate.problem;
    }
}

// The probes are meaningful only if campaigns use the same contact options.
TEST_F(Probe, TheDecksUseWhatIsProbed) {
    scenario::Scenario const scenario = scenario::parse_campaign(example_campaign, "test.toml").cases.front();
    std::string const campaign =
        deck::make_deck(prepare::prepare_case(scenario), {1}).files.at("in.liggghts");
    for (std::string const& text : {campaign, probe_deck().at("in.liggghts")}) {
        EXPECT_NE(text.find("gran model hertz tangential history limitForce on tangential_damping off\n"),
                  std::string::npos);
        EXPECT_NE(text.find("wall/gran model hertz tangential history mesh n_meshes 1 meshes trough "
                            "limitForce on tangential_damping off\n"),
                  std::string::npos);
    }
}

}  // namespace
}  // namespace vibrotrough::engine
