#include "sample_record.hpp"
#include "store/quantity.hpp"

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

}  // namespace
}  // namespace vibrotrough::store
