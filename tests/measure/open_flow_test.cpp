#include "measure/open_flow.hpp"

#include "core/error.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace vibrotrough::measure {
namespace {

/// Two grains at first; 10 are fed in each of four cycles, and from the third on 10 leave. Each weighs 1 g.
CycleSeries steady_flow() {
    CycleSeries series;
    series.open = {{0, 10, 20, 30, 40},
                   {0, 0.01, 0.02, 0.03, 0.04},
                   {0, 0, 0, 10, 10},
                   {0, 0, 0, 0.01, 0.01},
                   {2, 12, 22, 22, 22},
                   {0.002, 0.012, 0.022, 0.022, 0.022},
                   {0, 0.002, 0.004, 0.004, 0.004}};
    return series;
}

OpenFacts open_facts(int discarded) {
    return {0.1, 0.5, 100, discarded, 4, 800, 0.02, 0.1, 0.02 * 0.1};
}

core::TextFile dump(std::string const& name, std::string const& text) {
    return {"/packing/" + name, text};
}

std::string snapshot(long step, std::vector<std::string> const& grains) {
    std::string text = "ITEM: TIMESTEP\n" + std::to_string(step) + "\nITEM: NUMBER OF ATOMS\n" +
                       std::to_string(grains.size()) +
                       "\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\nITEM: ATOMS id x vx \n";
    for (std::string const& grain : grains) text += grain + " \n";
    return text;
}

TEST(OpenFlow, GrainsThatAddUpAreAllThere) {
    EXPECT_FALSE(imbalance(steady_flow()));
}

TEST(OpenFlow, AMissingGrainIsNamedWithItsCycle) {
    CycleSeries series = steady_flow();
    series.open.held[3] = series.open.held[4] = 21;
    EXPECT_NE(
        imbalance(series)->find("are missing at the end of cycle 3: 2 were there at first, 30 were fed, 21 "),
        std::string::npos);
    series = steady_flow();
    series.open.held_mass[2] += 1e-6;  // a grain that became heavier
    EXPECT_TRUE(imbalance(series));
}

TEST(OpenFlow, FlowsAreThoseOfTheCyclesThatCount) {
    OpenFlow const flow = open_flow(steady_flow(), {}, {dump("along.0.txt", "")}, "/packing", open_facts(2));
    EXPECT_NEAR(*flow.inflow, 0.1, 1e-14);
    EXPECT_NEAR(*flow.outflow, 0.1, 1e-14);
    EXPECT_NEAR(*flow.hold_up, 0.022, 1e-15);
    EXPECT_NEAR(*flow.window_depth, 0.004 / (800 * 0.1 * 0.02), 1e-14);
    // 95 % of 22 g are 20.9 g, which it held 0.89 of the way from the first to the second cycle's end.
    EXPECT_NEAR(*flow.fill_time, 0.189, 1e-14);
    EXPECT_FALSE(flow.residence_time);  // nobody is known to have left
}

// The level along a mesh is that of the mean depth of each bin, where a mesh is given.
TEST(OpenFlow, TheLevelIsThatOfTheMeanDepth) {
    std::string const bins = "# head\n# head\n# head\n400 2\n1 0.1 4 160 0.2\n2 0.3 2 80 0.2\n";
    OpenFacts facts = open_facts(2);
    OpenFlow const flat = open_flow(steady_flow(), {}, {dump("along.0.txt", bins)}, "/packing", facts);
    ASSERT_EQ(flat.along.depth.size(), 2u);
    EXPECT_TRUE(flat.along.level.empty());
    facts.level = [](double x, double mean_depth) { return 10 * x + mean_depth; };
    OpenFlow const mesh = open_flow(steady_flow(), {}, {dump("along.0.txt", bins)}, "/packing", facts);
    EXPECT_EQ(mesh.along.depth, flat.along.depth);
    ASSERT_EQ(mesh.along.level.size(), 2u);
    EXPECT_DOUBLE_EQ(mesh.along.level[1], 3 + flat.along.depth[1]);
}

// The grain with number 3 is the first that was fed, in the middle of the first tenth of cycle 1, at 0.005 s.
// It is found at the end of cycle 3, 10 mm behind the edge, where it had been for 20 ms: 0.3 - 0.02 - 0.005
// s. So are those after it, each fed 10 ms later.
TEST(OpenFlow, ResidenceIsFromTheFeedToTheEdge) {
    std::vector<LeftGrain> left;
    for (int i = 0; i < 20; ++i) left.push_back({3 + i / 10, 3 + i, 0.51, 0.5});
    OpenFlow const flow =
        open_flow(steady_flow(), left, {dump("along.0.txt", "")}, "/packing", open_facts(0));
    EXPECT_NEAR(*flow.residence_time, 0.275 - 0.045, 1e-14);
    EXPECT_NEAR(flow.residence.front(), 0.185, 1e-14);
    EXPECT_NEAR(flow.residence.back(), 0.275, 1e-14);
    left[0] = {1, 30, 0.51, 0.5};
    EXPECT_THROW(open_flow(steady_flow(), left, {}, "/packing", open_facts(0)), core::InputError);
}

// Cycles of 0.1, 0.1, 0.2 and 0.4 s: the grains that are found at the end of cycle 3, at 0.4 s, were fed from
// 0.005 s on, and left 20 ms before; those of cycle 4, at 0.8 s, a cycle later.
TEST(OpenFlow, CyclesOfStagesHaveTheirOwnTimes) {
    std::vector<LeftGrain> left;
    for (int i = 0; i < 20; ++i) left.push_back({3 + i / 10, 3 + i, 0.51, 0.5});
    OpenFacts staged = open_facts(0);
    staged.ends = {0, 0.1, 0.2, 0.4, 0.8};
    OpenFlow const flow = open_flow(steady_flow(), left, {dump("along.0.txt", "")}, "/packing", staged);
    EXPECT_NEAR(flow.residence.front(), 0.4 - 0.02 - 0.095, 1e-14);
    EXPECT_NEAR(flow.residence.back(), 0.8 - 0.02 - 0.105, 1e-14);
    EXPECT_NEAR(*flow.inflow, 0.04 / 0.8, 1e-15);
    EXPECT_NEAR(*flow.outflow, 0.02 / 0.8, 1e-15);
    EXPECT_FALSE(flow.fill_time);
}

// A run that was cut after step 200 and started again from step 100: the later file counts from there on, and
// its first snapshot, which is empty because the run before took the grains out, does not.
TEST(OpenFlow, WhatALaterRunRepeatedReplacesTheEarlier) {
    std::string const first =
        snapshot(0, {}) + snapshot(100, {"7 0.51 0.3"}) + snapshot(200, {"8 0.5 0.3", "9 0.5 0.3"});
    std::string const second =
        snapshot(100, {}) + snapshot(200, {"9 0.52 0.2"}) + snapshot(300, {"10 0.5 0.3"});
    auto const left = parse_left({dump("left.100.dump", second), dump("left.0.dump", first)}, 100, false);
    ASSERT_EQ(left.size(), 3u);
    EXPECT_EQ(left[0].id, 7);
    EXPECT_EQ(left[1].id, 9);
    EXPECT_EQ(left[1].cycle, 2);
    EXPECT_EQ(left[1].x, 0.52);
    EXPECT_EQ(left[2].id, 10);
}

TEST(OpenFlow, AnUnfinishedSnapshotIsLeftOutAndADamagedOneRefused) {
    std::string const whole = snapshot(0, {}) + snapshot(100, {"7 0.51 0.3"});
    std::string const next = snapshot(200, {"8 0.5 0.3"});
    for (std::size_t cut = 0; cut < next.size() - 1; cut += 5)
        EXPECT_EQ(parse_left({dump("left.0.dump", whole + next.substr(0, cut))}, 100, false).size(), 1u)
            << cut;
    EXPECT_THROW(parse_left({dump("left.0.dump", whole + "garbage\n")}, 100, false), core::InputError);
    EXPECT_THROW(parse_left({dump("left.0.dump", snapshot(100, {"seven 0 0"}))}, 100, false),
                 core::InputError);
    EXPECT_THROW(parse_left({dump("left.0.dump", snapshot(150, {}))}, 100, false), core::InputError);
}

// s = 2/Pe - 2/Pe^2 (1 - exp(-Pe)): 0.18 + 2e-2 exp(-10) at Pe = 10, 2 / e at Pe = 1, nearly 2/Pe for large
// ones.
TEST(OpenFlow, ThePecletNumberSolvesItsEquation) {
    EXPECT_NEAR(*peclet_number(0.18 + 0.02 * std::exp(-10)), 10, 1e-8);
    EXPECT_NEAR(*peclet_number(2 / std::exp(1)), 1, 1e-8);
    EXPECT_NEAR(*peclet_number(2e-6) / 1e6, 1, 1e-5);
    EXPECT_FALSE(peclet_number(0));
    EXPECT_FALSE(peclet_number(1));
}

}  // namespace
}  // namespace vibrotrough::measure
