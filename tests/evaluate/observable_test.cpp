#include "evaluate/observable.hpp"

#include "evaluate/case.hpp"
#include "store/sample_record.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>

namespace vibrotrough::evaluate {
namespace {

using Rows = std::vector<std::vector<double>>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Cycles that scatter by 0.05 about a mean, after a start-up that decays in two cycles.
std::vector<double> cycles_of(unsigned seed, double startup, int count = 60) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> scatter(0.8, 0.05);
    std::vector<double> values;
    for (int k = 0; k < count; ++k) values.push_back(scatter(random) + startup * std::exp(-k / 2.0));
    return values;
}

/// A case of three packings, evaluated as the program does.
store::CaseRecord measured_case() {
    store::CaseRecord record = store::sample_record();
    record.packings.resize(1);
    record.packings.resize(3, record.packings.front());
    std::vector<measure::PackingValues> values;
    for (int i = 0; i < 3; ++i) {
        auto& packing = record.packings[static_cast<std::size_t>(i)];
        packing.efficiency = cycles_of(static_cast<unsigned>(i + 1), i % 2 == 0 ? -0.6 : 0.6);
        values.push_back({packing.efficiency, start_of(i + 1)});
    }
    record.estimate = estimate_of(values, record.scenario);
    for (auto& packing : record.packings) packing.estimate.discarded = record.estimate.discarded;
    return record;
}

/// An observable with the values of the efficiency times a factor, plus what is added to each.
std::vector<ObservedPacking> as_efficiency(store::CaseRecord const& record, double factor, double added = 0) {
    std::vector<ObservedPacking> packings;
    for (auto const& packing : record.packings) {
        packings.push_back({static_cast<int>(packings.size()) + 1, {}});
        for (double const value : packing.efficiency)
            packings.back().cycles.push_back({factor * value + added});
    }
    return packings;
}

// The same numbers have the same mean and the same interval, whoever measured them. A factor of two is exact.
TEST(Observable, HasTheStatisticsOfTheEfficiency) {
    store::CaseRecord const record = measured_case();
    store::ObservedCase const found = observe_case(record, as_efficiency(record, 2), {});
    ASSERT_EQ(found.values.size(), 1u);
    EXPECT_EQ(found.values[0].mean, 2 * *record.estimate.mean);
    EXPECT_NEAR(*found.values[0].half_width, 2 * *record.estimate.half_width, 1e-14)
        << "fits of decays round";
    EXPECT_EQ(found.discarded, record.estimate.discarded);
    EXPECT_GT(found.discarded, 2) << "there is a start-up";
    EXPECT_EQ(found.discarded + found.measured, 60);
    EXPECT_EQ(found.packings, (std::vector{1, 2, 3}));
    EXPECT_EQ(found.values[0].steadiness, "steady");
}

// One packing has the interval of its own cycles, at the level of measure.confidence.
TEST(Observable, OfOnePackingHasTheIntervalOfItsCycles) {
    store::CaseRecord const record = measured_case();
    auto packings = as_efficiency(record, 1);
    packings.resize(1);
    auto const values = packings.front().cycles;
    std::vector<double> series;
    for (auto const& row : values) series.push_back(row.front());
    auto const wanted = measure::estimate_packing_after(record.estimate.discarded, series, {0.95, 0});
    store::ObservedCase const found = observe_case(record, packings, {});
    EXPECT_GE(found.discarded, record.estimate.discarded);
    if (found.discarded == record.estimate.discarded) {
        EXPECT_EQ(found.values[0].mean, wanted.mean);
        EXPECT_EQ(found.values[0].half_width, wanted.half_width);
    }
}

// An observable that needs longer than the efficiency loses more cycles, and never fewer.
TEST(Observable, LosesTheLongerStartUp) {
    store::CaseRecord const record = measured_case();
    auto packings = as_efficiency(record, 1);
    for (auto& packing : packings)
        for (std::size_t k = 0; k < 20; ++k) packing.cycles[k][0] += 5;
    std::vector<std::vector<double>> series(3);
    for (std::size_t i = 0; i < 3; ++i)
        for (auto const& row : packings[i].cycles) series[i].push_back(row[0]);
    std::vector<std::span<double const>> const runs(series.begin(), series.end());
    int const wanted = measure::common_startup_length(runs);
    EXPECT_THAT(wanted, testing::AllOf(testing::Ge(20), testing::Le(22)));
    EXPECT_EQ(observe_case(record, packings, {}).discarded, wanted);
    for (auto& packing : packings)
        for (auto& row : packing.cycles) row[0] = 7;  // constant: MSER cuts nothing
    store::ObservedCase const constant = observe_case(record, packings, {});
    EXPECT_EQ(constant.discarded, record.estimate.discarded);
    EXPECT_EQ(constant.values[0].mean, 7);
    EXPECT_EQ(constant.values[0].half_width, 0);
}

// Cycles at the beginning that have no value yet, in any packing, are a start-up; later ones are a gap.
TEST(Observable, LeavesOutCyclesBeforeItIsDefined) {
    store::CaseRecord const record = measured_case();
    auto packings = as_efficiency(record, 1);
    for (std::size_t k = 0; k < 25; ++k) packings[1].cycles[k][0] = nan;
    store::ObservedCase const late = observe_case(record, packings, {});
    EXPECT_GE(late.discarded, 25);
    ASSERT_TRUE(late.values[0].mean);
    double sum = 0;
    for (auto const& packing : packings)
        for (auto k = static_cast<std::size_t>(late.discarded); k < 60; ++k) sum += packing.cycles[k][0];
    EXPECT_NEAR(*late.values[0].mean, sum / 3 / late.measured, 1e-14);
    packings[1].cycles[40][0] = nan;
    EXPECT_FALSE(observe_case(record, packings, {}).values[0].mean);
}

// The points of a curve have one start-up; one without values does not harm the others.
TEST(Observable, IsACurvePointByPoint) {
    store::CaseRecord const record = measured_case();
    auto packings = as_efficiency(record, 1);
    for (auto& packing : packings)
        for (auto& row : packing.cycles) row = {row[0], -3 * row[0], nan};
    store::ObservedCase const found = observe_case(record, packings, {0.1, 0.2, 0.3});
    EXPECT_EQ(found.at, (std::vector{0.1, 0.2, 0.3}));
    ASSERT_EQ(found.values.size(), 3u);
    EXPECT_EQ(found.values[0].mean, record.estimate.mean);
    EXPECT_NEAR(*found.values[1].mean, -3 * *record.estimate.mean, 1e-14);
    EXPECT_NEAR(*found.values[1].half_width, 3 * *record.estimate.half_width, 1e-14);
    EXPECT_FALSE(found.values[2].mean);
}

// Packings count with the cycles that all of them have.
TEST(Observable, UsesTheCyclesThatAllPackingsHave) {
    store::CaseRecord const record = measured_case();
    auto packings = as_efficiency(record, 1);
    packings[2].cycles.resize(50);
    store::ObservedCase const found = observe_case(record, packings, {});
    EXPECT_EQ(found.discarded + found.measured, 50);
}

// A drive of given length has no start-up: the mean of all cycles, and Student's interval over the packings.
TEST(Observable, OfADriveOfGivenLengthUsesAllCycles) {
    store::CaseRecord record = measured_case();
    record.scenario.screen.opening = 0.002;
    ASSERT_TRUE(has_given_length(record.scenario));
    std::vector<ObservedPacking> const packings{{1, {{1.0}, {2.0}}}, {2, {{3.0}, {6.0}}}};
    store::ObservedCase const found = observe_case(record, packings, {});
    EXPECT_EQ(found.discarded, 0);
    EXPECT_EQ(found.values[0].mean, 3.0);
    // Means 1.5 and 4.5: t_1 s / sqrt(2) = 12.706 x 1.5, from any table.
    EXPECT_NEAR(*found.values[0].half_width, 12.7062 * 1.5, 1e-3);
}

// An observable belongs to one result of a case: another packing or cycle makes another one.
TEST(Observable, BelongsToTheResultThatItWasMeasuredIn) {
    store::CaseRecord record = measured_case();
    store::Observable observable{"height", "m", "Mean height", "", "", "", "", "", {}};
    observable.cases.push_back(observe_case(record, as_efficiency(record, 1), {}));
    EXPECT_EQ(observable.of(record), &observable.cases.front());
    store::CaseRecord longer = record;
    longer.packings.front().estimate.measured += 1;
    EXPECT_EQ(observable.of(longer), nullptr);
    store::CaseRecord more = record;
    more.packings.push_back(more.packings.front());
    EXPECT_EQ(observable.of(more), nullptr);
    record.id = "ba9876543210";
    EXPECT_EQ(observable.of(record), nullptr);
}

TEST(Observable, HasANameAndAUnitThatFitIntoEveryTable) {
    for (char const* name : {"height", "a", "t_2"}) EXPECT_TRUE(store::is_observable_name(name)) << name;
    for (char const* name : {"", "_a", "2nd", "Height", "a b", "h\xc3\xb6he", "a,b", "a\n"})
        EXPECT_FALSE(store::is_observable_name(name)) << name;
    EXPECT_FALSE(store::is_observable_name(std::string(61, 'a')));
    for (char const* unit : {"1", "m/s", "m2/s2", "kg s-1 m-1", "Pa"})
        EXPECT_TRUE(store::is_plain_unit(unit)) << unit;
    for (char const* unit : {"", "furlong per fortnight,", "m,s", "parsnip", "\xc2\xb5m", "m\x1b[31m"})
        EXPECT_FALSE(store::is_plain_unit(unit)) << unit;
}

}  // namespace
}  // namespace vibrotrough::evaluate
