#include "sample_record.hpp"
#include "store/quantity.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

// Values of a case that are more than the mean of those of its packings.
namespace vibrotrough::store {
namespace {

using std::numbers::pi;

/// The number that the tables have for a case.
std::optional<double> number_of_case(CaseRecord const& record, std::string_view name) {
    for (Quantity const& one : quantities())
        if (one.name == name && one.is_of_case()) return std::get<std::optional<double>>(one.of_case(record));
    throw std::out_of_range(std::string(name));
}

// Take-offs 0.1 before the end of a cycle and 0.3 after it are 0.4 apart, and their middle is at 0.1; flights
// of 3 and 4 rad are 3.5 rad on average. Tolerance: some roundings of numbers below 10.
TEST(QuantitiesOfTheLayer, PhasesAreAveragedOnTheCircle) {
    CaseRecord record = sample_record();
    measure::LayerMotion &first = record.packings[0].motion, &second = record.packings[1].motion;
    first.take_off_phase = 2 * pi - 0.1;
    first.landing_phase = *first.take_off_phase + 3;
    second.take_off_phase = 0.3;
    second.landing_phase = *second.take_off_phase + 4;
    EXPECT_NEAR(number_of_case(record, "take_off_phase").value(), 0.1, 1e-14);
    EXPECT_NEAR(number_of_case(record, "landing_phase").value(), 0.1 + 3.5, 1e-14);
    // Of one packing alone it is that packing's, within a turn.
    second.take_off_phase.reset();
    second.landing_phase.reset();
    EXPECT_NEAR(number_of_case(record, "take_off_phase").value(), 2 * pi - 0.1, 1e-14);
    EXPECT_NEAR(number_of_case(record, "landing_phase").value(), 2 * pi + 2.9, 1e-14);
    first.take_off_phase.reset();
    first.landing_phase.reset();
    EXPECT_FALSE(number_of_case(record, "take_off_phase"));
    EXPECT_FALSE(number_of_case(record, "landing_phase"));
}

// P = - m g sin(alpha) v with the mass that is on the trough: of an open one what it was measured to hold,
// and none where it becomes less. The packing's own mass is there a guess of what the feed will make.
// Tolerance: roundings of 2 mW.
TEST(QuantitiesOfTheLayer, GravityPullsAtTheMassThatIsThere) {
    CaseRecord record = sample_record();
    scenario::Trough const& trough = record.scenario.trough;
    double const of_kg = -trough.gravity * std::sin(trough.inclination) * 0.82 * velocity_scale(trough);
    EXPECT_NEAR(number_of_case(record, "gravity_power").value(), 0.0099 * of_kg, 1e-15);
    record.scenario.feed.mass_flow = 0.05;
    EXPECT_FALSE(number_of_case(record, "gravity_power"));
    record.packings[0].open.hold_up = 0.02;
    record.packings[1].open.hold_up = 0.03;
    EXPECT_NEAR(number_of_case(record, "gravity_power").value(), 0.025 * of_kg, 1e-15);
    record.scenario.feed = {};
    record.scenario.screen = {0.003, 0.001, 0.1};
    EXPECT_FALSE(number_of_case(record, "gravity_power"));
}

// Student's t of two values with one degree of freedom is tan(0.95 pi / 2) times half their difference.
// Speeds of 0.8 and 1.0 of the scale on 12 and 10 mm are flows of 9.6 and 10 mm: they scatter less than speed
// and depth do. What all packings share is of the speed alone. Tolerance: the quantile's, and roundings.
TEST(QuantitiesOfAnOpenTrough, TheFlowScattersAsTheProductsOfSpeedAndDepth) {
    CaseRecord record = sample_record();
    record.scenario.feed.mass_flow = 0.05;
    record.scenario.trough.width = 0.3;
    record.estimate.mean = 0.9;
    record.estimate.drift = 0.03;
    record.studied_error = 0.04;
    record.packings[0].estimate.mean = 0.8;
    record.packings[0].open.window_depth = 0.012;
    record.packings[1].estimate.mean = 1.0;
    record.packings[1].open.window_depth = 0.010;
    double const scale = velocity_scale(record.scenario.trough);
    double const bulk_density = scenario::settled_solid_fraction * 1400;
    double const scatter = std::tan(0.95 * pi / 2) * (0.010 - 0.0096) / 2;
    double const wanted = std::hypot(scatter, 0.05 * 0.011) * scale * bulk_density;
    EXPECT_NEAR(number_of_case(record, "mass_flow_per_width").value(), 0.9 * 0.011 * scale * bulk_density,
                1e-12);
    EXPECT_NEAR(number_of_case(record, "mass_flow_per_width_half_width").value(), wanted, 1e-9);
    EXPECT_NEAR(number_of_case(record, "mass_flow_half_width").value(), wanted * 0.3, 1e-9);
    // The scatter of one packing is not known, as that of its depth is not.
    record.packings.pop_back();
    EXPECT_EQ(number_of_case(record, "mass_flow_per_width_half_width"), INFINITY);
}

}  // namespace
}  // namespace vibrotrough::store
