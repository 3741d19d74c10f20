#include "compare/comparison.hpp"

#include "atlas/value.hpp"
#include "store/sample_record.hpp"
#include "theory/point_mass.hpp"
#include "theory/quantities.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace vibrotrough::compare {
namespace {

store::CaseRecord const record = store::sample_record("0123456789ab");

scenario::Scenario scenario_at(double vibration_angle_deg, double inclination_deg) {
    scenario::Scenario scenario = record.scenario;
    scenario.trough.vibration_angle = vibration_angle_deg * std::numbers::pi / 180;
    scenario.trough.inclination = inclination_deg * std::numbers::pi / 180;
    return scenario;
}

TEST(Compare, ShowsTheInputs) {
    Row const row = compare("0123456789ab", prepare::prepare_case(record.scenario), {}, "open");
    EXPECT_EQ(row.id, "0123456789ab");
    EXPECT_EQ(row.friction, 0.23);
    EXPECT_EQ(row.amplitude_m, 0.006);
    EXPECT_EQ(row.frequency_hz, 13.5);
    // The glossary's formulas; converted numbers are rounded to 12 digits, half of the last of them is 5e-12
    // of a number that begins with 1.
    double const omega = 2 * std::numbers::pi * 13.5;
    double const machine_number = omega * omega * 0.006 / 9.81;
    EXPECT_NEAR(row.machine_number, machine_number, 5e-12 * machine_number);
    double const throw_number = machine_number * std::sin(0.5) / std::cos(-0.05);
    EXPECT_NEAR(row.throw_number, throw_number, 5e-12 * throw_number);
    EXPECT_NEAR(row.vibration_angle_deg, 0.5 * 180 / std::numbers::pi, 1e-10);
    EXPECT_NEAR(row.inclination_deg, -0.05 * 180 / std::numbers::pi, 1e-11);
}

TEST(Compare, ShowsAnglesAsTheyWereWritten) {
    for (double const angle : {1.0, 12.5, 20.0, 30.0, 45.0, 60.0, 89.0}) {
        EXPECT_EQ(compare("", prepare::prepare_case(scenario_at(angle, 0)), {}, "open").vibration_angle_deg,
                  angle);
    }
    for (double const angle : {-45.0, -2.86, 0.0, 3.0, 15.1}) {
        EXPECT_EQ(compare("", prepare::prepare_case(scenario_at(30, angle)), {}, "open").inclination_deg,
                  angle);
    }
}

TEST(Compare, PredictsWithTheTheory) {
    scenario::Trough const& trough = record.scenario.trough;
    theory::Motion const motion = theory::solve({.throw_number = throw_number(trough),
                                                 .tan_vibration_angle = std::tan(0.5),
                                                 .tan_inclination = std::tan(-0.05),
                                                 .friction = 0.23});
    ASSERT_TRUE(motion.converged);
    Row const row = compare("", prepare::prepare_case(record.scenario), {}, "open");
    EXPECT_EQ(row.efficiency_theory, motion.velocity_efficiency);
    EXPECT_EQ(row.mode_theory, motion.mode);
}

TEST(Compare, KnowsTheFactsSheetsPointMass) {
    // Gamma = 2, tan(beta) = 0.5, mu = 0.23, level: 0.5815 (four digits).
    scenario::Scenario scenario = record.scenario;
    scenario::Trough& trough = scenario.trough;
    trough.inclination = 0;
    trough.vibration_angle = std::atan(0.5);
    trough.frequency =
        std::sqrt(2 * scenario::gravity / (trough.amplitude * std::sin(trough.vibration_angle))) /
        (2 * std::numbers::pi);
    EXPECT_NEAR(compare("", prepare::prepare_case(scenario), {}, "open").efficiency_theory.value(), 0.5815,
                0.0005);
}

// The theory's commands and the campaigns stand on the same ground.
TEST(Compare, OneGravity) {
    EXPECT_EQ(theory::Machine{}.gravity, scenario::gravity);
}

// A trough that shakes along itself, horizontal: forward and backward slides are mirror images, eta = 0.
TEST(Compare, HasTheoryForADriveAlongTheTrough) {
    Row const row = compare("", prepare::prepare_case(scenario_at(0, 0)), {}, "open");
    EXPECT_NEAR(row.efficiency_theory.value(), 0, 1e-9);  // the theory takes tan(beta) = 1e-12 there
    EXPECT_EQ(row.throw_number, 0);
}

TEST(Compare, ShowsTheMeasurement) {
    Row const row = compare("0123456789ab", prepare::prepare_case(record.scenario), record, "not looked at");
    EXPECT_EQ(row.outcome, "not-precise");
    EXPECT_EQ(row.number("efficiency"), 0.82);
    EXPECT_EQ(row.number("efficiency_half_width_statistics"), 0.127);
    // speed = eta omega r cos(beta), multiplied in another order: some roundings.
    EXPECT_NEAR(row.number("conveying_speed").value(),
                0.82 * 2 * std::numbers::pi * 13.5 * 0.006 * std::cos(0.5), 1e-15);
    EXPECT_EQ(row.layer_mode, "FP'N");
    EXPECT_EQ(row.number("packings"), 2);
    EXPECT_EQ(row.number("cycles_measured"), 1 + 1);
    EXPECT_EQ(row.number("cycles_discarded"), 2 + 0);
    EXPECT_EQ(row.number("wall_time"), 12.5 + 11.25);
}

// m' = v m / (L W) times the width of the trough; the interval scales with it. The sample has added masses of
// 0.002 and 0.003 kg, dampings of 0.5 and 0.7 kg/s and powers of 0.04 and 0.06 W. Tolerance: rounding.
TEST(Compare, KnowsMassFlowPowerAndReaction) {
    store::CaseRecord loaded = record;
    for (std::size_t i = 0; i < 2; ++i) {
        loaded.packings[i].motion.added_mass = i == 0 ? 0.002 : 0.003;
        loaded.packings[i].motion.damping = i == 0 ? 0.5 : 0.7;
        loaded.packings[i].motion.trough_power = i == 0 ? 0.04 : 0.06;
    }
    auto const prepared = prepare::prepare_case(record.scenario);
    Row const row = compare("", prepared, loaded, "");
    double const area = 0.036 * 0.018, speed = 0.82 * 2 * std::numbers::pi * 13.5 * 0.006 * std::cos(0.5);
    double const mass = mass_per_area(record.scenario) * area;
    EXPECT_NEAR(mass, prepared.mass, 0.005 * mass) << "the sizes of 500 grains are rounded to whole numbers";
    EXPECT_NEAR(row.number("mass_flow_per_width").value(), speed * mass / area, 1e-12);
    double const half_width = std::hypot(0.127, prepared.numerics.total());
    EXPECT_NEAR(
        row.number("mass_flow_per_width_half_width").value() / row.number("mass_flow_per_width").value(),
        half_width / 0.82, 1e-12);
    EXPECT_FALSE(row.number("mass_flow"))
        << "a layer that is periodic across is a piece of a trough of any width";
    EXPECT_NEAR(row.number("power_per_area").value(), 0.05 / area, 1e-9);
    EXPECT_NEAR(row.number("added_mass_per_area").value(), 0.0025 / area, 1e-12);
    EXPECT_NEAR(row.number("added_mass_fraction").value(), 0.0025 / mass, 1e-12);
    EXPECT_NEAR(row.number("damping_per_area").value(), 0.6 / area, 1e-9);

    scenario::Scenario wide = record.scenario;
    wide.trough.width = 0.3;
    loaded.scenario = wide;
    Row const whole = compare("", prepare::prepare_case(wide), loaded, "");
    EXPECT_NEAR(whole.number("mass_flow").value(), 0.3 * row.number("mass_flow_per_width").value(), 1e-12);
    wide.trough.width.reset();
    wide.trough.side_wall_friction = 0.2;
    loaded.scenario = wide;
    EXPECT_NEAR(compare("", prepare::prepare_case(wide), loaded, "").number("mass_flow").value(),
                0.018 * row.number("mass_flow_per_width").value(), 1e-12)
        << "between side walls the width is known";
}

// Theory at the friction that was measured, beside theory at the grain's.
TEST(Compare, HasTheoryAtTheLayersFriction) {
    Row const row =
        compare("", prepare::prepare_case(record.scenario), {}, "open", MeasuredFriction{0.15, 0.14, 0.17});
    EXPECT_EQ(row.friction_layer, 0.15);
    EXPECT_EQ(row.friction_layer_low, 0.14);
    EXPECT_EQ(row.friction_layer_high, 0.17);
    scenario::Scenario smooth = record.scenario;
    smooth.trough.friction = 0.15;
    Row const wanted = compare("", prepare::prepare_case(smooth), {}, "open");
    EXPECT_EQ(row.efficiency_theory_layer, wanted.efficiency_theory);
    EXPECT_EQ(row.mode_theory_layer, wanted.mode_theory);
    EXPECT_NE(row.efficiency_theory_layer, row.efficiency_theory);
    EXPECT_FALSE(compare("", prepare::prepare_case(record.scenario), {}, "open").friction_layer);
    EXPECT_FALSE(compare("", prepare::prepare_case(record.scenario), {}, "open").efficiency_theory_layer);
}

TEST(Compare, MakesNoNumberOfWhatWasNotSteady) {
    store::CaseRecord unsteady = record;
    unsteady.outcome = core::Outcome::not_steady;
    Row const row = compare("", prepare::prepare_case(record.scenario), unsteady, "");
    EXPECT_EQ(row.outcome, "not-steady");
    EXPECT_FALSE(row.number("efficiency"));
    EXPECT_FALSE(row.number("efficiency_half_width_statistics"));
    EXPECT_FALSE(row.number("conveying_speed"));
    EXPECT_EQ(row.number("packings"), 2) << "the packings are counted nevertheless";
    EXPECT_EQ(row.number("cycles_measured"), 2);
    EXPECT_TRUE(row.efficiency_theory);
}

TEST(Compare, MakesNoNumberOfAnIntervalWithoutEnd) {
    store::CaseRecord unknown = record;
    unknown.estimate.half_width.reset();
    Row const row = compare("", prepare::prepare_case(record.scenario), unknown, "");
    EXPECT_EQ(row.number("efficiency"), 0.82);
    EXPECT_FALSE(row.number("efficiency_half_width_statistics"));
}

// An infinite half-width is unbounded, a curve without a value is NaN: neither is a number of a table.
TEST(Compare, TakesNumbersThatAreNotFiniteAsUnknown) {
    EXPECT_EQ(value_of(0.5), Value(0.5));
    EXPECT_FALSE(value_of(std::nullopt));
    EXPECT_FALSE(value_of(INFINITY));
    EXPECT_FALSE(value_of(NAN));
}

// A study takes the place of what is expected, and the whole is the root of the sum of squares.
TEST(Compare, TakesTheStudiedErrorInPlaceOfTheExpectedOne) {
    auto const prepared = prepare::prepare_case(record.scenario);
    Row const bound = compare("0123456789ab", prepared, record, "");
    EXPECT_EQ(bound.number("efficiency_numerics"), prepared.numerics.total());
    EXPECT_TRUE(is_expected(bound));
    EXPECT_NEAR(bound.number("efficiency_half_width").value(), std::hypot(0.127, prepared.numerics.total()),
                1e-15);
    store::CaseRecord studied = record;
    studied.studied_error = 0.034;
    Row const measured = compare("0123456789ab", prepared, studied, "");
    EXPECT_EQ(measured.number("efficiency_numerics"), 0.034);
    EXPECT_EQ(measured.of("numerics_source"), Value(std::string("convergence")));
    EXPECT_FALSE(is_expected(measured));
    EXPECT_NEAR(measured.number("efficiency_half_width").value(), std::hypot(0.127, 0.034), 1e-15);
    EXPECT_NEAR(
        measured.number("conveying_speed_half_width").value() / measured.number("conveying_speed").value(),
        std::hypot(0.127, 0.034) / 0.82, 1e-12);
}

// The larger of the two errors is named, and neither when one of them is not known.
TEST(Compare, SaysWhichErrorIsLarger) {
    Row row = compare("0123456789ab", prepare::prepare_case(record.scenario), record, "");
    EXPECT_EQ(larger_error(row), "statistical") << "what is expected is below 0.06";
    row.set("efficiency_numerics", {});
    EXPECT_FALSE(larger_error(row)) << "unknown is not zero";
    row.set("efficiency_numerics", 0.126);  // the sample's half-width is 0.127
    EXPECT_EQ(larger_error(row), "statistical");
    row.set("efficiency_numerics", 0.128);
    EXPECT_EQ(larger_error(row), "numerical");
    row.set("efficiency_half_width_statistics", {});
    EXPECT_FALSE(larger_error(row));
}

TEST(Compare, HasNoMeasurementWithoutARecord) {
    for (char const* outcome : {"open", "running", "interrupted", "lost-grains"}) {
        Row const row = compare("", prepare::prepare_case(record.scenario), {}, outcome);
        EXPECT_EQ(row.outcome, outcome);
        EXPECT_FALSE(row.number("efficiency"));
        EXPECT_FALSE(row.number("efficiency_half_width_statistics"));
        EXPECT_FALSE(row.number("conveying_speed"));
        EXPECT_FALSE(row.layer_mode);
        EXPECT_FALSE(row.number("packings"));
        EXPECT_FALSE(row.number("cycles_measured"));
        EXPECT_FALSE(row.number("cycles_discarded"));
        EXPECT_FALSE(row.number("wall_time"));
        EXPECT_TRUE(row.efficiency_theory);
    }
}

/// A line of the curves that has the atlas: throw number, efficiency, half-width.
std::vector<std::array<double, 3>> atlas_line(std::vector<Row> const& cases) {
    std::vector<std::array<double, 3>> found;
    std::istringstream text(theory_curves_csv(cases));
    std::string line;
    std::getline(text, line);
    EXPECT_TRUE(line.ends_with(",rolling_layer_efficiency,atlas_efficiency,atlas_half_width"));
    while (std::getline(text, line)) {
        std::vector<std::string> cells;
        std::istringstream row(line);
        for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
        if (cells.size() == 8)
            found.push_back({std::stod(cells[0]), std::stod(cells[6]), std::stod(cells[7])});
    }
    return found;
}

// Between cases that lie inside of the atlas, a layer between them: numbers that change with the throw number
// in proportion. Beyond the outermost cases, and where cases of one throw number differ, there is none. The
// throw number is written with six digits.
TEST(TheoryCurves, HaveTheAtlasBetweenTheCases) {
    std::vector<Row> cases;
    for (double const gamma : {1.5, 2.0, 3.0}) {
        Row row{};
        row.throw_number = gamma;
        row.vibration_angle_deg = 30;
        row.friction = 0.3;
        row.atlas_place =
            atlas::Place{gamma, std::tan(std::numbers::pi / 6), 0, 0.3, gamma, 4.5, 0.5, 0.1, 0.5};
        cases.push_back(row);
    }
    auto const line = atlas_line(cases);
    EXPECT_GT(line.size(), 30U);
    for (auto const& [gamma, efficiency, half_width] : line) {
        EXPECT_GT(gamma, 1.5);
        EXPECT_LE(gamma, 3.0);
        atlas::Place place = *cases.front().atlas_place;
        place[0] = place[4] = gamma;
        auto const value = atlas::value_at(place);
        EXPECT_NEAR(efficiency, value->efficiency, 1e-4) << gamma;
        EXPECT_NEAR(half_width, value->half_width, 1e-4) << gamma;
    }
    cases.push_back(cases.front());
    cases.back().atlas_place->at(5) = 3;
    EXPECT_TRUE(atlas_line(cases).empty());
}

}  // namespace
}  // namespace vibrotrough::compare
