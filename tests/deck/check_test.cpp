#include "deck/check.hpp"

#include "deck/campaign_check.hpp"
#include "deck/deck.hpp"
#include "deck/estimates.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"
#include "scenario/reader/keys.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace vibrotrough::deck {
namespace {

using std::numbers::pi;

prepare::PreparedCase prepared(scenario::Scenario const& s) {
    return prepare::prepare_case(s);
}

Finding finding(scenario::Scenario const& s, std::string const& item) {
    auto const all = check(prepared(s));
    auto const found = std::ranges::find(all, item, &Finding::item);
    if (found == all.end()) throw std::out_of_range(item);
    return *found;
}

// Possible, but hardly any machine or material: told only where it is so, with the slip that would explain
// it.
TEST(Check, TellsWhatIsUnusual) {
    scenario::Scenario s = scenario_of();
    EXPECT_THROW(finding(s, "machine number"), std::out_of_range);
    EXPECT_THROW(finding(s, "density of the grains"), std::out_of_range);
    s.grains.density = 0.6;  // t/m3 taken for kg/m3
    Finding const light = finding(s, "density of the grains");
    EXPECT_NE(light.severity, Severity::fine);
    EXPECT_NE(light.advice.find("0.6 t/m3 meant (600 kg/m3)"), std::string::npos) << light.advice;
    // K = omega^2 r / g: a stroke taken for the amplitude doubles it.
    s = scenario_of();
    double const omega = 2 * pi * s.trough.frequency;
    s.trough.amplitude = 10 * scenario::gravity / (omega * omega);
    Finding const strong = finding(s, "machine number");
    EXPECT_NEAR(strong.measured, 10, 1e-12);
    EXPECT_EQ(strong.severity, Severity::warning);
    EXPECT_EQ(strong.key, "trough.amplitude");
    EXPECT_NE(strong.advice.find("was the stroke given as the amplitude"), std::string::npos)
        << strong.advice;
}

// tan(20 deg) = 0.364 > 0.23 > tan(12 deg) = 0.213: without grip, up- and downhill, a layer has no mean
// speed.
TEST(Check, WarnsOfALayerThatRunsAway) {
    char const* const item = "friction that holds the layer on its slope";
    for (char const* const angle : {"20 deg", "-20 deg"}) {
        Finding const steep = finding(
            scenario_of(with("inclination = \"0 deg\"", fmt::format("inclination = \"{}\"", angle))), item);
        EXPECT_EQ(steep.severity, Severity::warning);
        EXPECT_EQ(steep.measured, 0.23);
        EXPECT_NEAR(steep.limit, std::tan(pi / 9), 1e-12);
        EXPECT_NE(steep.advice.find(fmt::format("on {} with a friction of 0.23", angle)), std::string::npos)
            << steep.advice;
    }
    EXPECT_THROW(finding(scenario_of(with("\"0 deg\"", "\"-12 deg\"")), item), std::out_of_range);
}

// What the user typed is named, in its unit: a stroke, turns of the drive, a bulk density, a throw number.
TEST(Check, NamesWhatIsUnusualAsItWasTyped) {
    scenario::Scenario const slow = scenario_of(with("amplitude = \"6 mm\"", "stroke = \"120 mm\"",
                                                     with("throw_number = 2.0", "frequency = \"16 rpm\"")));
    Finding const turns = finding(slow, "speed of the drive");
    EXPECT_EQ(turns.key, "trough.frequency");
    EXPECT_EQ(turns.unit, "1/min");
    EXPECT_NEAR(turns.measured, 16, 1e-12);
    EXPECT_NE(turns.advice.find("were 16 Hz meant, not rpm?"), std::string::npos) << turns.advice;
    scenario::Scenario const wide = scenario_of(with("amplitude = \"6 mm\"", "stroke = \"120 mm\""));
    Finding const stroke = finding(wide, "stroke");
    EXPECT_EQ(stroke.key, "trough.stroke");
    EXPECT_NEAR(stroke.measured, 120, 1e-12);
    EXPECT_EQ(stroke.unit, "mm");
    scenario::Scenario const light =
        scenario_of(with("density = \"1400 kg/m3\"", "bulk_density = \"0.6 kg/m3\""));
    Finding const bulk = finding(light, "bulk density");
    EXPECT_EQ(bulk.key, "grains.bulk_density");
    EXPECT_NE(bulk.advice.find("were 0.6 t/m3 meant (600 kg/m3)?"), std::string::npos) << bulk.advice;
    // 600 lb/ft3, where kg/m3 were meant.
    scenario::Scenario const heavy =
        scenario_of(with("density = \"1400 kg/m3\"", "bulk_density = \"9611 kg/m3\""));
    EXPECT_EQ(finding(heavy, "bulk density").severity, Severity::warning);
    // The frequency follows from the throw number, which is what can be changed.
    scenario::Scenario const fast = scenario_of(with("amplitude = \"6 mm\"", "stroke = \"4 um\""));
    EXPECT_EQ(finding(fast, "frequency").key, "trough.throw_number");
}

// One grain of the floor carries rho phi g h d^2 where the layer is h high; the example is asked for as 12 mm
// at a solid fraction of 0.58, rounded to whole grains (1 / 500).
TEST(Estimates, BottomLoadIsTheColumnsWeight) {
    scenario::Scenario const s = scenario_of();
    EXPECT_NEAR(bottom_load(prepared(s)), 1400 * 0.58 * 9.81 * 0.012 * 0.003 * 0.003,
                0.003 * bottom_load(prepared(s)));
    scenario::Scenario steep = s;
    steep.trough.inclination = std::atan(0.75);
    EXPECT_NEAR(bottom_load(prepared(steep)), 0.8 * bottom_load(prepared(s)), 1e-12);
}

// A mass m on a spring that its weight compresses by D has the stiffness m g / D. With the kinetic energy m g
// h it goes on to press with m g (1 + sqrt(2 h / D)), which must stay within the 2 % by which a packing at
// rest may differ from its weight: with grains of 1 GPa 1e-7 diameters would be too much. D goes with
// E^(-2/3).
TEST(Estimates, StifferGrainsMustRestMoreQuietly) {
    scenario::Scenario s = scenario_of();
    s.grains.youngs_modulus = 5e6;
    EXPECT_DOUBLE_EQ(height_at_rest(prepared(s)), 1e-7 * mean_diameter(s));
    double before = 0;
    for (double const modulus : {1e9, 8e9}) {
        s.grains.youngs_modulus = modulus;
        prepare::PreparedCase const p = prepared(s);
        double const compressed = p.layer_height / mean_diameter(s) * overlap_under(p, bottom_load(p) / 2);
        EXPECT_LT(std::sqrt(2 * height_at_rest(p) / compressed), 0.015);
        EXPECT_LT(height_at_rest(p), 0.5e-7 * mean_diameter(s));
        if (before > 0) {
            EXPECT_NEAR(height_at_rest(p) / before, 0.25, 0.01);
        }
        before = height_at_rest(p);
    }
}

// F = 4/3 E* sqrt(R) d^(3/2), evaluated by hand with E* = 5e6 / (2 (1 - 0.35^2)) = 2.849003e6 Pa.
TEST(Estimates, HertzOverlapCarriesTheForce) {
    double const overlap = overlap_under(prepared(scenario_of()), 1e-3);
    EXPECT_NEAR(4.0 / 3 * 2.849003e6 * std::sqrt(0.0015) * std::pow(overlap, 1.5), 1e-3, 1e-9);
}

// m v^2 / 2 = 8/15 E* sqrt(R) d^(5/2): all kinetic energy is in the contact.
TEST(Estimates, ImpactOverlapHoldsTheEnergy) {
    scenario::Scenario const s = scenario_of(with("diameter_spread = 0.1", "diameter_spread = 0.0"));
    double const overlap = overlap_at_impact(prepared(s), 0.7);
    double const mass = 1400 * pi / 6 * std::pow(0.003, 3);
    EXPECT_NEAR(8.0 / 15 * 2.849003e6 * std::sqrt(0.0015) * std::pow(overlap, 2.5), mass * 0.49 / 2,
                1e-6 * mass);
}

// The duration of a Hertz impact is 2.9432 d_max / v (Johnson, section 11.4): a check of both against each
// other; 2.87 has three digits.
TEST(Estimates, ImpactDurationBelongsToItsOverlap) {
    scenario::Scenario const s = scenario_of();
    EXPECT_NEAR(impact_duration(prepared(s), 0.7), 2.9432 * overlap_at_impact(prepared(s), 0.7) / 0.7,
                2e-3 * impact_duration(prepared(s), 0.7));
    EXPECT_NEAR(impact_duration(prepared(s), 32 * 0.7) * 2, impact_duration(prepared(s), 0.7),
                1e-12);  // v^(-1/5)
}

// Eq. 15 of the theory: at Gamma = sqrt(1 + pi^2) the flight lasts exactly one cycle; none below Gamma = 1.
TEST(Estimates, FlightTime) {
    scenario::Scenario const full =
        scenario_of(with("throw_number = 2.0", fmt::format("throw_number = {}", std::sqrt(1 + pi * pi))));
    EXPECT_NEAR(flight_time(prepared(full)) * full.trough.frequency, 1, 1e-6);
    EXPECT_EQ(flight_time(prepared(scenario_of(with("throw_number = 2.0", "throw_number = 0.99")))), 0);
}

TEST(Estimates, SkinIsTheDecks) {
    scenario::Scenario const s = scenario_of();
    EXPECT_NE(make_deck(prepared(s), {1})
                  .files.at("in.liggghts")
                  .find(fmt::format("neighbor        {} bin", skin_in_diameters * s.grains.diameter)),
              std::string::npos);
}

// Student's t(0.9875; P - 1) x 0.03 / sqrt(P) is 0.0203 for P = 14 and 0.0194 for P = 15 (t = 2.533, 2.510);
// 0.0627 and 0.0469 for P = 4 and 5 (t = 4.177, 3.495), of which half of the whole half-width is asked. A
// block has no numerical errors, so that all of the half-width is left to statistics.
TEST(Estimates, PackingsAreWhatTheHalfWidthNeeds) {
    scenario::Scenario asking = scenario_of();
    scenario::MeasurementPlan& plan = asking.measure;
    auto const packings = [&](double half_width) {
        plan.half_width = half_width;
        return expected_packings(plan, half_width, {.deviation = 0.03});
    };
    EXPECT_EQ(packings(0.02), 15);
    EXPECT_EQ(packings(0.1), 5);
    EXPECT_EQ(packings(0.13), 4) << "the least number, in pairs";
    EXPECT_EQ(packings(0.001), 24) << "the largest";
    plan.packings = plan.max_packings = 1;
    EXPECT_EQ(packings(0.001), 1);
    EXPECT_EQ(expected_cycles(asking), 24);
    plan.max_cycles = 20;
    EXPECT_EQ(expected_cycles(asking), 20);
}

// The numerical errors take 0.8 of 0.05, so that 0.03 = 0.6 x 0.05 is left: as many packings as for 0.03.
TEST(Estimates, PackingsAreMoreWhereNumericsTakeAShare) {
    scenario::Scenario asking = prepared(scenario_of()).scenario;
    double const numerics = prepare::numerical_errors(asking).total();
    asking.measure.half_width = numerics / 0.8;
    EXPECT_NEAR(prepare::statistics_plan(asking).half_width, 0.75 * numerics, 1e-12);
    scenario::MeasurementPlan alone = asking.measure;
    alone.half_width = 0.75 * numerics;
    double const whole = asking.measure.half_width;
    Experience const scattered{.deviation = 0.06};  // more than five packings, which have a rule of their own
    EXPECT_EQ(expected_packings(asking, scattered), expected_packings(alone, whole, scattered));
    EXPECT_GT(expected_packings(asking, scattered), expected_packings(asking.measure, whole, scattered));
}

TEST(Estimates, WorkIsThatOfCyclesAndSettling) {
    scenario::Scenario const s = scenario_of();
    // Settling comes to the cycles: 5 falls are a few cycles long.
    double const cycles = s.layer.grains * prepared(s).time.steps_per_cycle * expected_cycles(s);
    EXPECT_GT(expected_work(prepared(s), 1), cycles);
    EXPECT_LT(expected_work(prepared(s), 1), 2 * cycles);
}

// Asked for 0.05: for less, the bounds of the numerical errors of such a box leave too little to statistics.
TEST(Check, TheExampleIsFine) {
    std::string const stiff =
        with("youngs_modulus = \"5 MPa\"\n", "", with("half_width = 0.02", "half_width = 0.05"));
    for (Finding const& one : check(prepared(scenario_of(stiff)))) {
        EXPECT_EQ(one.severity, Severity::fine) << one.item << ": " << one.measured;
        EXPECT_TRUE(std::isfinite(one.measured)) << one.item;
        EXPECT_FALSE(one.advice.empty()) << one.item;
    }
}

// Bound 4 s^2, an error from twice the half-width on (src/prepare/numerical_errors.hpp): 14 diameters of 5
// MPa.
TEST(Check, SoftGrainsOfADeepLayerAreAnError) {
    char const* const item = "error of eta by soft grains";
    Finding const deep = finding(scenario_of(with("height = \"12 mm\"", "height = \"42 mm\"")), item);
    EXPECT_EQ(deep.severity, Severity::error);
    EXPECT_EQ(deep.key, "grains.youngs_modulus");
    EXPECT_NE(deep.advice.find("leave out grains.youngs_modulus"), std::string::npos) << deep.advice;
    std::string const wide = with("half_width = 0.02", "half_width = 0.05");
    EXPECT_EQ(finding(scenario_of(wide), item).severity, Severity::warning) << "four diameters, for +- 0.05";
}

// A modulus that the program chose cannot be left out; the cures are what it was chosen by, and the
// half-width. Both numbers are enough, and no more than a fifth beyond that: two digits, of which 5 % are
// kept in reserve.
TEST(Check, AChosenModulusHasTheCuresOfWhoChoseIt) {
    char const* const item = "error of eta by soft grains";
    std::string const chosen = with("youngs_modulus = \"5 MPa\"\n", "");
    auto const narrow = with("half_width = 0.02", "half_width = 0.0005", chosen);
    Finding const soft = finding(scenario_of(narrow), item);
    EXPECT_EQ(soft.severity, Severity::error);
    EXPECT_EQ(soft.key, "solver.softness");
    double softness = 0, half_width = 0;
    ASSERT_EQ(std::sscanf(soft.advice.c_str(), "lower it to %lf, or allow a half-width of %lf:", &softness,
                          &half_width),
              2)
        << soft.advice;
    EXPECT_GT(half_width, 2 * soft.measured);
    EXPECT_LT(half_width, 1.2 * 2 * soft.measured);
    Finding const cured =
        finding(scenario_of(narrow + fmt::format("[solver]\nsoftness = {}\n", softness)), item);
    EXPECT_EQ(cured.severity, Severity::fine) << cured.measured;
    EXPECT_EQ(finding(scenario_of(chosen), "steps per cycle, at most").key, "solver.softness");
    EXPECT_EQ(finding(scenario_of(), "steps per cycle, at most").key, "grains.youngs_modulus");
    EXPECT_EQ(
        finding(scenario_of(), "steps between rebuilds of neighbour lists at twice the trough's speed").key,
        "solver.rayleigh_fraction");
}

// A block is one body with a contact of its own: nothing of layers, and its contact is T / 300.
TEST(Check, ABlockIsNoLayer) {
    std::string const one_size = with("diameter_spread = 0.1", "diameter_spread = 0.0");
    scenario::Scenario const s = scenario_of(with("height = \"12 mm\"", "block = \"point\"", one_size));
    EXPECT_NEAR(finding(s, "contact time at the trough's speed / cycle").measured, 1.0 / 300, 1e-12);
    EXPECT_EQ(finding(s, "contact time at the trough's speed / cycle").key, "solver.block_stiffness");
    for (Finding const& one : check(prepared(s))) {
        EXPECT_EQ(one.severity, Severity::fine) << one.item << ": " << one.measured;
        EXPECT_EQ(one.item.find("layer"), std::string::npos) << one.item;
    }
}

TEST(Check, EveryItemHasItsOwnNameAndAKeyThatExists) {
    std::set<std::string> names;
    for (Finding const& one : check(prepared(scenario_of()))) {
        EXPECT_TRUE(names.insert(one.item).second) << one.item;
        EXPECT_NE(scenario::find_key(one.key), nullptr) << one.key;
    }
}

// Each bad value is found where it is, and softening or shrinking by more makes an error of the warning.
TEST(Check, FindsWhatIsWrong) {
    char const* const impact = "overlap of a grain at impact at twice the trough's speed / diameter";
    auto const modulus = [](char const* value) {
        return scenario_of(with("youngs_modulus = \"5 MPa\"", fmt::format("youngs_modulus = \"{}\"", value)));
    };
    EXPECT_EQ(finding(modulus("0.5 MPa"), impact).severity, Severity::warning);
    scenario::Scenario soft = modulus("0.1 MPa");
    soft.trough.amplitude = 0.06;
    soft.trough.frequency = 10;
    EXPECT_EQ(finding(soft, impact).severity, Severity::error);
    EXPECT_EQ(finding(soft, impact).key, "grains.youngs_modulus");
    EXPECT_NE(finding(soft, "overlap under the layer's own weight / diameter").severity, Severity::fine);

    auto const shortened = scenario_of(with("length = \"36 mm\"", "length = \"15 mm\""));
    EXPECT_EQ(finding(shortened, "periodic length / diameter").severity, Severity::warning);
    EXPECT_NEAR(finding(shortened, "periodic length / diameter").measured, 5, 1e-12);
    auto const high = scenario_of(with("height = \"12 mm\"", "height = \"50 mm\""));
    EXPECT_EQ(finding(high, "periodic length / layer height").severity, Severity::warning);
    auto const many = scenario_of(with("frames_per_cycle = 0", "frames_per_cycle = 1000"));
    // 102 bytes for each grain in each frame of the first packing outweigh everything else.
    EXPECT_NEAR(1e9 * finding(many, "disk").measured / (102.0 * 1000 * 24 * many.layer.grains), 1, 0.1);
}

TEST(Check, AContactMustBeShortAgainstTheFlight) {
    constexpr char const* item = "contact time at the trough's speed / flight time";
    // Gamma a little above 1: a hop of a fifth of a cycle, which soft grains do not resolve.
    std::string const soft = with("youngs_modulus = \"5 MPa\"", "youngs_modulus = \"0.5 MPa\"",
                                  with("throw_number = 2.0", "throw_number = 1.05"));
    auto const hop = finding(scenario_of(soft), item);
    EXPECT_NE(hop.severity, Severity::fine) << hop.measured;
    // Below, and where the point mass only grazes, there is no flight to compare with.
    for (char const* gamma : {"0.9", "1.0", "1.000000001", "1.0001", "1.01"}) {
        EXPECT_THROW(
            finding(scenario_of(with("throw_number = 2.0", std::string("throw_number = ") + gamma)), item),
            std::out_of_range)
            << gamma;
    }
}

// The trough's speed is omega r where its motion has no harmonics; an impact takes twice that speed at most.
TEST(Check, ContactTimesAreThoseAtTheTroughsSpeed) {
    scenario::Scenario const s = scenario_of();
    double const speed = 2 * pi * s.trough.frequency * s.trough.amplitude;
    EXPECT_NEAR(finding(s, "contact time at the trough's speed / cycle").measured,
                impact_duration(prepared(s), speed) * s.trough.frequency, 1e-12);
}

TEST(CampaignCheck, KnowsTheSoftestAndTheStiffestGrains) {
    scenario::Campaign campaign = scenario::parse_campaign(example_campaign, "test.toml");
    campaign.cases = {campaign.cases.front(), campaign.cases.front(), campaign.cases.front()};
    for (auto const& [i, modulus] : {std::pair{0, 6e6}, {1, 5e6}, {2, 7e6}})
        campaign.cases[static_cast<std::size_t>(i)].grains.youngs_modulus = modulus;
    CampaignCheck const total = check_campaign(campaign);
    EXPECT_EQ(total.least_modulus, 5e6);
    EXPECT_EQ(total.most_modulus, 7e6);
}

// Harmonics of the drive and triangles of a mesh are worked out beside the grains; a sinusoid on a flat floor
// is part of the usual speed.
TEST(Estimates, HarmonicsTakeTime) {
    scenario::Scenario s = scenario_of();
    auto const plain = prepared(s);
    EXPECT_DOUBLE_EQ(work_of(plain, 0, 3), plain.work(3));
    EXPECT_GT(work_of(plain, 1, 3), plain.work(3));
    s.trough.harmonics = {{2, 0.1, 0}, {3, 0.1, 0}};
    auto const rich = prepared(s);
    double const more = static_cast<double>(rich.motion.along.size() + rich.motion.normal.size()) - 2;
    EXPECT_GE(more, 2);
    EXPECT_DOUBLE_EQ(work_of(rich, 0, 3), rich.work(3) + 20 * more * rich.time.steps_per_cycle * 3);
}

}  // namespace
}  // namespace vibrotrough::deck
