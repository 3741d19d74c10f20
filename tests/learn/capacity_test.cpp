// The search for the largest feed of an open trough: C with every feed <= C carried and every larger one not.

#include "learn/capacity.hpp"

#include "store/summary.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace vibrotrough::learn {
namespace {

using testing::DoubleEq;
using testing::Optional;

/// All feeds that are tried until the search ends by itself.
std::vector<FeedTrial> search(double capacity, double first, double precision) {
    std::vector<FeedTrial> trials;
    while (auto const feed = next_feed(trials, first, precision))
        trials.push_back({*feed, *feed <= capacity});
    return trials;
}

TEST(Capacity, BeginsWithTheFirstFeedAndDoublesOrHalves) {
    EXPECT_THAT(next_feed({}, 3, 0.1), Optional(3.0));
    EXPECT_THAT(next_feed({{3, true}}, 3, 0.1), Optional(6.0));
    EXPECT_THAT(next_feed({{3, false}}, 3, 0.1), Optional(1.5));
    // sqrt(3 * 6) = 4.2426, of which three digits are kept.
    EXPECT_THAT(next_feed({{3, true}, {6, false}}, 3, 0.1), Optional(DoubleEq(4.24)));
}

// The bracket holds the capacity, and its ratio is at most 1 + precision. From a factor of two it takes
// log2(ln 2 / ln(1 + precision)) halvings of its logarithm: 6.1 for 1 %; rounding to three digits may cost
// one.
RC_GTEST_PROP(Capacity, IsBracketedAsPreciselyAsAsked, ()) {
    double const capacity = std::exp(*rc::gen::inRange(-6000, 6000) / 1000.0);
    double const precision = *rc::gen::inRange(10, 500) / 1000.0;
    auto const trials = search(capacity, 1, precision);
    CapacityBounds const bounds = capacity_bounds(trials);
    RC_ASSERT(bounds.carried.has_value());
    RC_ASSERT(bounds.refused.has_value());
    RC_ASSERT(!bounds.contradiction.has_value());
    RC_ASSERT(*bounds.carried <= capacity);
    RC_ASSERT(*bounds.refused > capacity);
    RC_ASSERT(*bounds.refused <= *bounds.carried * (1 + precision));
    double const doublings = std::ceil(std::abs(std::log2(capacity))) + 1;
    double const halvings = std::ceil(std::log2(std::log(2) / std::log1p(precision))) + 1;
    RC_ASSERT(static_cast<double>(trials.size()) <= doublings + 1 + std::max(0.0, halvings));
}

TEST(Capacity, EndsWhereNothingIsRefusedOrNothingIsCarried) {
    EXPECT_EQ(search(1e300, 1, 0.1).size(), 12);
    EXPECT_EQ(search(0, 1, 0.1).size(), 12);
    EXPECT_FALSE(capacity_bounds(search(1e300, 1, 0.1)).refused);
    EXPECT_FALSE(capacity_bounds(search(0, 1, 0.1)).carried);
}

// Of trials of an earlier call, or near the capacity by chance: what was carried above a refusal does not
// count.
TEST(Capacity, NamesAContradiction) {
    CapacityBounds const bounds = capacity_bounds({{4, true}, {2, false}, {1, true}, {3, true}});
    EXPECT_THAT(bounds.carried, Optional(1.0));
    EXPECT_THAT(bounds.refused, Optional(2.0));
    EXPECT_THAT(bounds.contradiction, Optional(4.0));
}

/// The record of a case with a packing for each outflow (kg/s), which were all fed with 1 kg/s.
store::CaseRecord record_with(std::vector<double> const& outflows) {
    store::CaseRecord record{};
    record.scenario.measure.confidence = 0.95;
    record.scenario.feed.mass_flow = 1;
    for (double const outflow : outflows) {
        store::PackingRecord packing{};
        packing.open.inflow = 1;
        packing.open.outflow = outflow;
        packing.series.open.fed = {0, 1e6};
        record.packings.push_back(packing);
    }
    return record;
}

// What finds no room above the layer is not fed: in and out then agree at less than was asked for.
TEST(Capacity, IsReachedWhereTheFeedFindsNoRoom) {
    store::CaseRecord record = record_with({1, 1});
    for (double const asked : {1.02, 1.05}) {
        record.scenario.feed.mass_flow = asked;
        EXPECT_EQ(is_overfed(core::Outcome::finished, &record), asked > 1.03) << asked;
    }
}

/// As the command asks: it sees a summary, cut from the result or read from the file beside it.
bool is_refused(core::Outcome outcome, std::vector<double> const& outflows) {
    store::CaseRecord whole = record_with(outflows);
    whole.outcome = outcome;
    store::CaseRecord const cut = store::summary_of(whole);
    store::CaseRecord const read = store::unpack_summary(store::pack_summary(whole), whole.scenario);
    bool const answer = is_overfed(outcome, &whole);
    EXPECT_EQ(is_overfed(outcome, &cut), answer);
    EXPECT_EQ(is_overfed(outcome, &read), answer);
    return answer;
}

// A trough fills when less leaves it than is fed, by more than the 2 % and the interval of unsteady_flow():
// of one packing 2 / sqrt(n), of a million grains another 0.2 %.
TEST(Capacity, IsNotReachedWhileWhatIsFedAlsoLeaves) {
    using enum core::Outcome;
    EXPECT_TRUE(is_refused(not_steady, {0.8, 0.81, 0.79}));
    EXPECT_TRUE(is_refused(not_steady, {0.9}));
    // Not steady for another reason: it empties, its speed drifts, or its packings differ.
    EXPECT_FALSE(is_refused(not_steady, {1.2, 1.21, 1.19}));
    EXPECT_FALSE(is_refused(not_steady, {0.99, 0.995, 0.985}));
    EXPECT_FALSE(is_refused(not_steady, {0.7, 1.1, 1.0}));
    EXPECT_FALSE(is_overfed(not_steady, nullptr));
}

TEST(Capacity, IsReachedWhereTheLayerReachesTheFeed) {
    using enum core::Outcome;
    EXPECT_TRUE(is_overfed(overfull, nullptr));
    for (core::Outcome const other : {finished, not_precise, bistable_or_slow})
        EXPECT_FALSE(is_refused(other, {0.8, 0.81, 0.79})) << name_of(other);
}

}  // namespace
}  // namespace vibrotrough::learn
