#include "deck/deck.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "deck/atom_types.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <regex>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace vibrotrough::deck {
namespace {

using std::numbers::pi;

/// Both decks, one after the other.
std::string decks(scenario::Scenario const& s, int packing = 1) {
    Deck const deck = make_deck(prepare::prepare_case(s), {packing});
    return deck.files.at("settle.liggghts") + deck.files.at("in.liggghts");
}

/// The number after `before` in the deck.
double number_after(std::string const& deck, std::string const& before) {
    auto const at = deck.find(before);
    EXPECT_NE(at, std::string::npos) << before;
    return std::stod(deck.substr(at + before.size()));
}

// An open trough has a back wall, a feed and an edge, and no phases; other troughs have none of it, so that
// their ids stay what they were.
TEST(Deck, AnOpenTroughIsFedAndDischarged) {
    std::string const text =
        with("height = \"12 mm\"\n", "", with("36 mm", "200 mm")) + "[feed]\nmass_flow = \"0.1 t/h\"\n";
    scenario::Scenario const s =
        scenario_of(with("friction = 0.23", "friction = 0.23\nside_wall_friction = 0", text));
    prepare::PreparedCase const prepared = prepare::prepare_case(s);
    Deck const deck = make_deck(prepared, {1});
    std::string const drive = deck.files.at("in.liggghts");
    EXPECT_TRUE(deck.files.contains("back.stl"));
    for (char const* part : {"boundary        f f f", "insert/rate/region", "meshes trough left right back",
                             "delete_atoms    region outlet"})
        EXPECT_NE(drive.find(part), std::string::npos) << part;
    EXPECT_EQ(drive.find("phases.csv"), std::string::npos);
    EXPECT_EQ(number_after(drive, "massrate "), *s.feed.mass_flow);
    // One grain of each of the three sizes is there at first.
    EXPECT_EQ(prepared.settled_grains, 3);
    EXPECT_NEAR(prepared.settled_weight / prepared.weight * s.layer.grains, 3, 0.05);
    std::string const periodic = decks(scenario_of());
    for (char const* part : {"feed", "back.stl", "outlet", "along."})
        EXPECT_EQ(periodic.find(part), std::string::npos) << part;
}

// A short trough is closed at its edge while its first grains come to rest, and only then; a long one has its
// deck without a gate.
TEST(Deck, OfAShortOpenTroughKeepsItsFirstGrainsFromTheEdge) {
    for (char const* length : {"60 mm", "900 mm"}) {
        std::string const text = with("height = \"12 mm\"\n", "", with("36 mm", length)) +
                                 "[feed]\nmass_flow = \"0.1 t/h\"\nlength = \"20 mm\"\n";
        auto const prepared = prepare::prepare_case(
            scenario_of(with("friction = 0.23", "friction = 0.23\nside_wall_friction = 0", text)));
        Deck const deck = make_deck(prepared, {1});
        std::string const& settle = deck.settle_files.at(settle_file);
        bool const is_short = prepared.scenario.layer.length < 0.1;
        EXPECT_EQ(settle.find("primitive type 2 xplane 0.06") != std::string::npos, is_short);
        EXPECT_EQ(settle.find("unfix           gate") < settle.find("write_restart"), is_short);
        EXPECT_EQ(deck.files.at(drive_file).find("gate"), std::string::npos);
    }
}

// A grain that has just not left the trough at the end of a cycle falls, and flies on with the trough's
// largest speed, for a whole cycle before it is taken out.
TEST(Deck, GrainsAreTakenOutBeforeTheyLeaveTheBox) {
    std::string const text =
        with("height = \"12 mm\"\n", "", with("36 mm", "200 mm")) + "[feed]\nmass_flow = \"0.1 t/h\"\n";
    prepare::PreparedCase const c = prepare::prepare_case(
        scenario_of(with("friction = 0.23", "friction = 0.23\nside_wall_friction = 0", text)));
    prepare::OpenTrough const& open = *c.domain.open;
    double const period = 1 / c.scenario.trough.frequency, way = c.largest_speed * period;
    EXPECT_LT(c.box_bottom, open.out_z - way - 9.81 / 2 * period * period);
    EXPECT_GT(open.box_end, open.out_x + way);
    EXPECT_GT(c.box_top, open.feed_top);
    EXPECT_LT(open.out_near_x + 0.0033,
              0.2);  // behind it nothing lies below the floor but what has fallen over the edge
    EXPECT_LT(open.feed_end, open.window_start);
    EXPECT_LT(open.window_end, 0.2);
}

// On a short trough the feed reaches the edge with the speed of its fall: the box holds its flight until the
// end of the cycle. In a long one it has lost that speed, and the box is as long as the trough throws.
TEST(Deck, TheBoxOfAShortTroughHoldsWhatTheFallOfTheFeedThrowsOverTheEdge) {
    for (char const* length : {"60 mm", "400 mm"}) {
        std::string const text = with("height = \"12 mm\"\n", "", with("36 mm", length)) +
                                 "[feed]\nmass_flow = \"0.1 t/h\"\nheight = \"60 mm\"\nlength = \"20 mm\"\n";
        prepare::PreparedCase const c = prepare::prepare_case(
            scenario_of(with("friction = 0.23", "friction = 0.23\nside_wall_friction = 0", text)));
        prepare::OpenTrough const& open = *c.domain.open;
        double const fed = std::sqrt(open.feed_speed * open.feed_speed + 2 * 9.81 * open.feed_top);
        EXPECT_GT(fed, 2 * c.largest_speed);
        EXPECT_EQ(open.box_end > open.out_x + fed / c.scenario.trough.frequency,
                  c.scenario.layer.length < 0.1);
    }
}

// m = rho pi / 6 sum d^3 over three classes of equal number.
TEST(Deck, MassAndWeightOfThreeClasses) {
    scenario::Scenario const s =
        scenario_of(with("height = \"12 mm\"", "grains = 300", with("\"0 deg\"", "\"10 deg\"")));
    prepare::PreparedCase const prepared = prepare::prepare_case(s);
    double const volume = 100 * pi / 6 * (std::pow(2.7e-3, 3) + std::pow(3e-3, 3) + std::pow(3.3e-3, 3));
    EXPECT_NEAR(prepared.mass, 1400 * volume, 1e-12);
    EXPECT_NEAR(prepared.weight, prepared.mass * scenario::gravity * std::cos(10 * pi / 180), 1e-12);
}

TEST(Deck, CountsEqualWithinOne) {
    for (int const grains : {1, 2, 3, 100, 101, 500}) {
        std::string const deck =
            decks(scenario_of(with("height = \"12 mm\"", fmt::format("grains = {}", grains))));
        std::regex const target("particles_in_region ([0-9]+)");
        int last = 0, most = 0, least = grains;
        for (std::sregex_iterator match(deck.begin(), deck.end(), target), end; match != end; ++match) {
            int const total = std::stoi((*match)[1]);
            most = std::max(most, total - last);
            least = std::min(least, total - last);
            last = total;
        }
        EXPECT_EQ(last, grains);
        EXPECT_LE(most - least, 1);
    }
}

TEST(Deck, ASingleGrainIsOfTheMiddleSize) {
    std::string const deck = decks(scenario_of(with("height = \"12 mm\"", "grains = 1")));
    EXPECT_NE(deck.find("1 of diameter 0.003 m"), std::string::npos);
}

TEST(Deck, OneSizeIsOneClass) {
    std::string const deck = decks(scenario_of(with("diameter_spread = 0.1", "diameter_spread = 0.0")));
    EXPECT_EQ(deck.find("class2"), std::string::npos);
}

// 36.3 mm / 1.5 / 3 mm = 8 columns, each slightly wider than an eighth, so that rounding does not add a
// ninth.
TEST(Deck, CutsTheLayerIntoBins) {
    scenario::Scenario const s = scenario_of(with("length = \"36 mm\"", "length = \"36.3 mm\""));
    std::string const deck = decks(s);
    int const n = prepare::prepare_case(s).time.steps_per_cycle;
    EXPECT_EQ(number_after(deck, "window all ave/time 1 "), n / 100);
    EXPECT_EQ(number_after(deck, "phases all print "), n / 100);
    EXPECT_EQ(number_after(deck, "profiles all ave/spatial "), 3 * n / 10);
    EXPECT_EQ(number_after(deck, " z 0.0 "), 0.0015);
    double const column = number_after(deck, " x lower ");
    EXPECT_GT(column, 0.0363 / 8);
    EXPECT_NEAR(column, 0.0363 / 8, 1e-13);
}

// g (-sin(alpha), 0, -cos(alpha)): uphill positive, gravity pulls a layer on an incline backwards.
TEST(Deck, TiltsGravityNotTheTrough) {
    std::string const deck = decks(scenario_of(with("inclination = \"0 deg\"", "inclination = \"30 deg\"")));
    EXPECT_NEAR(number_after(deck, "fix             gravity all gravity 9.81 vector "), -0.5, 1e-15);
    EXPECT_NE(deck.find("vector -0.49999999999999994 0 -0.8660254037844387"), std::string::npos);
}

TEST(Deck, AvoidsTheKnownPitfalls) {
    for (std::string const& text :
         {example_campaign,
          with("rolling_friction = 0.0", "rolling_friction = 0.1\nrotation = \"rolling\"")}) {
        std::string const deck = decks(scenario_of(text));
        // Coulomb friction needs both options, in the pair style and in the wall.
        std::regex const coulomb("limitForce on tangential_damping off");
        EXPECT_EQ(std::distance(std::sregex_iterator(deck.begin(), deck.end(), coulomb), {}), 4);
        // Every thermo_style resets "lost", whose default hides lost grains.
        std::regex const style("thermo_style.*\\nthermo_modify +lost error");
        std::regex const any_style("\\nthermo_style");
        EXPECT_EQ(std::distance(std::sregex_iterator(deck.begin(), deck.end(), style), {}),
                  std::distance(std::sregex_iterator(deck.begin(), deck.end(), any_style), {}));
        // Phase 0 is step 0: the clock is reset before the drive starts.
        EXPECT_LT(deck.find("reset_timestep  0"), deck.find("move/mesh"));
        EXPECT_LT(deck.find("move/mesh"), deck.find("fix             means"));
        EXPECT_EQ(deck.find("{{"), std::string::npos);
    }
    EXPECT_EQ(decks(scenario_of()).find("rolling_friction epsd2"), std::string::npos);
}

// A sweep over drives settles each packing once, because the first deck does not depend on the drive.
TEST(Deck, CasesThatDifferByTheirDriveShareThePacking) {
    auto const settle = [](std::string const& text) {
        return make_deck(prepare::prepare_case(scenario_of(text)), {1}).settle_files;
    };
    auto const first = settle(example_campaign);
    EXPECT_EQ(first, settle(with("throw_number = 2.0", "throw_number = 3.0")));
    EXPECT_EQ(first, settle(with("vibration_angle = \"30 deg\"", "vibration_angle = \"20 deg\"")));
    EXPECT_EQ(first, settle(with("amplitude = \"6 mm\"", "amplitude = \"5 mm\"")));
    EXPECT_EQ(first, settle(with("max_cycles = 200", "max_cycles = 20")));
    EXPECT_EQ(first, settle(with("pvc-horizontal", "another")));
    EXPECT_EQ(first,
              settle(with("throw_number = 2.0", "throw_number = 2.0\nharmonics = [\"3, 0.1, 0 deg\"]")));
    EXPECT_NE(first, settle(with("friction = 0.23", "friction = 0.24")));
    EXPECT_NE(first, settle(with("\"0 deg\"", "\"1 deg\"")));
    EXPECT_NE(first, make_deck(prepare::prepare_case(scenario_of()), {2}).settle_files);
}

// Every order has 50 steps in its period.
TEST(Deck, HarmonicsHaveSteps) {
    scenario::Scenario s =
        scenario_of(with("throw_number = 2.0", "throw_number = 2.0\nharmonics = [\"100, 0.2, 0 deg\"]"));
    EXPECT_GE(prepare::prepare_case(s).time.steps_per_cycle, 5000);
}

TEST(Deck, RotationChoosesTheIntegrator) {
    auto const integrator = [](std::string const& lines) {
        return decks(scenario_of(with("rolling_friction = 0.0", lines)));
    };
    EXPECT_NE(integrator("rotation = \"free\"").find("integrate all nve/sphere\n"), std::string::npos);
    EXPECT_NE(integrator("rotation = \"blocked\"").find("integrate all nve\n"), std::string::npos);
    std::string const rods = decks(scenario_of(with("diameter_spread = 0.1", "shape = \"rod\"")));
    EXPECT_NE(rods.find("particletemplate/multisphere"), std::string::npos);
    EXPECT_NE(rods.find("integrate all multisphere allow_group_and_set yes\n"), std::string::npos);
    EXPECT_NE(rods.find("atoms/3"), std::string::npos);
}

TEST(Deck, ALongRunPausesAtTheSameCyclesAsOneThatIsContinued) {
    PackingPlan const plan{1, 200, {}, 24};
    EXPECT_EQ(plan.next_stop(0), 24);
    EXPECT_EQ(plan.next_stop(23), 24);
    EXPECT_EQ(plan.next_stop(24), 48);
    EXPECT_EQ(plan.next_stop(192), 200);
    EXPECT_EQ((PackingPlan{1, 24, {}, 24}.next_stop(0)), 24);
    EXPECT_EQ((PackingPlan{1, 30, {}, 0}.next_stop(10)), 30) << "no pauses";
    EXPECT_EQ((PackingPlan{1}.next_stop(0)), 0) << "until max_cycles";
}

TEST(Deck, ControlSaysAfterWhichCycleARunEnds) {
    prepare::PreparedCase const prepared = prepare::prepare_case(scenario_of());
    EXPECT_EQ(make_deck(prepared, {1}).files.at("control.in"), control_go_on);
    std::string const control = make_deck(prepared, {1, 24}).files.at("control.in");
    EXPECT_NE(control.find("variable stop equal ${done}>=24\n"), std::string::npos);
    EXPECT_NE(control.find("write_restart checkpoint.24.restart"), std::string::npos);
    // All else is the same, so that a packing can be continued with more cycles.
    EXPECT_EQ(make_deck(prepared, {1, 24}).files.at("in.liggghts"),
              make_deck(prepared, {1, 48}).files.at("in.liggghts"));
}

// velocity all set V NULL NULL with V = eta omega r cos(beta), before the first cycle only.
TEST(Deck, GrainsMayStartWithASpeed) {
    prepare::PreparedCase const prepared = prepare::prepare_case(scenario_of());
    std::string const started = make_deck(prepared, {2, 24, 0.5}).files.at("in.liggghts");
    std::string const command = fmt::format(
        "if \"${{done}} == 0\" then \"velocity all set {:.6g} NULL NULL\"\n", 0.5 * prepared.velocity_scale);
    EXPECT_NE(started.find(command), std::string::npos) << started;
    EXPECT_EQ(make_deck(prepared, {2, 24}).files.at("in.liggghts").find("velocity all"), std::string::npos);
}

TEST(Deck, SideWallsAreMeshesThatMove) {
    Deck const deck = make_deck(prepare::prepare_case(scenario_of(with(
                                    "restitution = 0.5", "restitution = 0.5\nside_wall_friction = 0.3"))),
                                {1});
    std::string const& text = deck.files.at("in.liggghts");
    EXPECT_TRUE(deck.files.contains("left.stl") && deck.files.contains("right.stl"));
    EXPECT_NE(text.find("boundary        p f f"), std::string::npos);
    EXPECT_NE(text.find("n_meshes 3 meshes trough left right"), std::string::npos);
    EXPECT_NE(text.find("fix             drive_right all move/mesh mesh right"), std::string::npos);
    // grain-grain, grain-floor, grain-wall of three types
    EXPECT_NE(text.find("peratomtypepair 3 0.5 0.23 0.3 0.23 0.23 0.3 0.3 0.3 0.3"), std::string::npos);
}

TEST(Deck, SoftGrainsNeedAnExtraCommand) {
    EXPECT_EQ(decks(scenario_of()).find("soft_particles"), std::string::npos);
    std::string const soft = decks(scenario_of(with("5 MPa", "1 MPa")));
    EXPECT_LT(soft.find("soft_particles  yes"), soft.find("create_box"));
}

// LIGGGHTS refuses more than 1 GPa without it, which stiff_enough() chooses for deep layers.
TEST(Deck, HardGrainsNeedAnExtraCommand) {
    EXPECT_EQ(decks(scenario_of(with("5 MPa", "1000 MPa"))).find("hard_particles"), std::string::npos);
    std::string const hard = decks(scenario_of(with("5 MPa", "1500 MPa")));
    EXPECT_LT(hard.find("hard_particles  yes"), hard.find("create_box"));
}

TEST(Deck, PackingsDifferBySeedsAndOnlyTheFirstHasFrames) {
    scenario::Scenario s = scenario_of();
    s.output.frames_per_cycle = 10;
    Deck const first = make_deck(prepare::prepare_case(s), {1}),
               second = make_deck(prepare::prepare_case(s), {2});
    EXPECT_NE(packing_seed(1), packing_seed(2));
    EXPECT_NE(first.files.at("in.liggghts").find("dump            frames"), std::string::npos);
    EXPECT_EQ(second.files.at("in.liggghts").find("dump            frames"), std::string::npos);
    EXPECT_THROW(make_deck(prepare::prepare_case(s), {0}), std::invalid_argument);
    EXPECT_THROW(make_deck(prepare::prepare_case(s), {1001}), std::invalid_argument);
    EXPECT_NO_THROW(make_deck(prepare::prepare_case(s), {1000}));
}

// Gold deck: a change of the deck shows here, a change of the physics in tests/end_to_end. When a template
// was changed on purpose, write the new deck over the old one and say why in the commit:
//   vibrotrough deck tests/deck/gold/campaign.toml --output DIR
TEST(Deck, IsTheGoldDeck) {
    std::filesystem::path const gold = GOLD_FOLDER;
    Deck const deck =
        make_deck(prepare::prepare_case(scenario::read_campaign(gold / "campaign.toml").cases.front()), {2});
    for (auto const& [name, content] : deck.files) EXPECT_EQ(content, core::read_file(gold / name)) << name;
}

// The angle of the drive in a ramp is 2 pi n (a u + b u^2) at the share u of its time: a + b = 1, so that it
// ends after n whole cycles, and the frequencies at its ends, a and a + 2 b, are those of the stages.
TEST(Deck, ARampEndsAfterWholeCyclesAtTheNewFrequency) {
    std::string const stages =
        "[[stages]]\ncycles = 4\n[[stages]]\nramp_cycles = 3\ncycles = 9\nfrequency = \"20 Hz\"\n";
    std::string const text =
        with("throw_number = 2.0", "frequency = \"10 Hz\"", with("max_cycles = 200\n", ""));
    std::string const deck = decks(scenario_of(text + stages));
    std::regex const angle(R"(2\*PI\*3\*v_\w+\*\(([-+.e\d]+)\+\(([-+.e\d]+)\)\*v_)");
    std::smatch found;
    ASSERT_TRUE(std::regex_search(deck, found, angle));
    double const a = std::stod(found[1]), b = std::stod(found[2]);
    EXPECT_NEAR(a + b, 1, 1e-12);
    EXPECT_NEAR((a + 2 * b) / a, 2, 1e-12);
}

// The table of types and the number of a material's type agree, with side walls and without.
TEST(Deck, MaterialsHaveTheTypesOfTheTable) {
    for (std::string const walls : {"", "\nside_wall_friction = 0.3"}) {
        std::string text = with("restitution = 0.5", "restitution = 0.5" + walls);
        for (char const* name : {"fines", "coarse"})
            text += fmt::format("\n[[materials]]\nname = \"{}\"\nmass_fraction = 0.2\n", name);
        prepare::PreparedCase const prepared = prepare::prepare_case(scenario_of(text));
        std::vector<AtomType> const types = atom_types(prepared);
        ASSERT_EQ(prepared.materials.size(), 3u);
        for (int material = 0; material < 3; ++material) {
            auto const type = static_cast<std::size_t>(atom_type_of(prepared, material));
            ASSERT_LE(type, types.size());
            EXPECT_EQ(types[type - 1].material, &prepared.materials[static_cast<std::size_t>(material)]);
        }
    }
}

}  // namespace
}  // namespace vibrotrough::deck
