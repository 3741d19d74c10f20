#include "measure/size_flows.hpp"

#include <gtest/gtest.h>

namespace vibrotrough::measure {
namespace {

/// Two sizes on openings of 5 mm, in the order of the deck, the larger first. One of each lies on the screen
/// at first; two of each are fed in each of two cycles. Masses are the cubes of the diameters in mm.
std::vector<ScreenedSize> const flow_sizes{{0.006, 2, 216}, {0.002, 2, 8}};
std::vector<PassedGrain> const left_over{{1, 1, 0.006}, {2, 4, 0.006}, {2, 5, 0.002}};
std::vector<PassedGrain> const gone_through{{1, 2, 0.002}, {2, 3, 0.002}};

CycleSeries on_fed_screen() {
    CycleSeries series;
    series.normal_force = {0, 0};
    OpenSeries& open = series.open;
    open.held = {2, 4, 5};
    open.held_mass = {224, 448, 664};
    open.fed = {0, 4, 8};
    open.fed_mass = {0, 448, 896};
    open.left = {0, 1, 2};
    open.left_mass = {0, 216, 224};
    open.passed = {0, 1, 1};
    open.passed_mass = {0, 8, 8};
    open.of_size = {{1, 3, 4}, {1, 3, 4}};
    return series;
}

std::vector<SizeFlow> flows() {
    return size_flows(on_fed_screen(), left_over, gone_through, flow_sizes);
}

TEST(SizeFlows, FollowEachSize) {
    auto const found = flows();
    EXPECT_EQ(found[0].diameter, 0.002);
    EXPECT_EQ(found[0].held, (std::vector<double>{1, 2, 2}));
    EXPECT_EQ(found[0].fed, (std::vector<double>{0, 2, 4}));
    EXPECT_EQ(found[1].held, (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(found[1].fed, (std::vector<double>{0, 2, 4}));
    EXPECT_FALSE(flow_imbalance(on_fed_screen(), found));
}

// Of 3 small grains that went, 2 passed: a mass of 16 of the undersize of 24, beside 432 of oversize.
TEST(SizeFlows, GiveThePartition) {
    Screening const s = screening_of_flows(flows(), 0.005, 0, 2, 0.1);
    EXPECT_EQ(s.number, (std::vector<double>{3, 2}));
    EXPECT_EQ(s.passed, (std::vector<double>{2, 0}));
    EXPECT_DOUBLE_EQ(*s.efficiency, 2.0 / 3);
    EXPECT_DOUBLE_EQ(*s.passed_share, 16.0 / 456);
    EXPECT_DOUBLE_EQ(*s.undersize, 8.0 / 440);
    EXPECT_DOUBLE_EQ(*s.underflow, 16 / 0.2);
    EXPECT_NEAR(*s.cut_size, 0.002 + 0.25 * 0.003, 1e-15);  // a third stays; all as large as the opening stay
    EXPECT_EQ(s.by_size.held, (std::vector<double>{1, 2, 2, 1, 2, 3}));
    EXPECT_FALSE(screening_of_flows(flows(), 0.005, 2, 2, 0.1).efficiency);
}

// The negative controls: a grain that is in no file, one that changed its size, one that was lost on the
// screen while another one was fed, and one of a size that was not fed.
TEST(SizeFlows, MissingAndWrongGrainsAreNamed) {
    auto fewer = gone_through;
    fewer.pop_back();
    EXPECT_NE(flow_imbalance(on_fed_screen(), size_flows(on_fed_screen(), left_over, fewer, flow_sizes))
                  ->find("passed the screen"),
              std::string::npos);
    auto other = gone_through;
    other[1].size = 0.006;
    EXPECT_TRUE(flow_imbalance(on_fed_screen(), size_flows(on_fed_screen(), left_over, other, flow_sizes)));
    CycleSeries changed = on_fed_screen();
    changed.open.of_size = {{1, 3, 5}, {1, 3, 3}};
    EXPECT_TRUE(flow_imbalance(changed, size_flows(changed, left_over, gone_through, flow_sizes)));
    auto fine = left_over;
    fine[2].size = 0.001;
    EXPECT_NE(flow_imbalance(on_fed_screen(), size_flows(on_fed_screen(), fine, gone_through, flow_sizes))
                  ->find("left over the edge"),
              std::string::npos);
}

}  // namespace
}  // namespace vibrotrough::measure
