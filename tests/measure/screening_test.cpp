#include "measure/screening.hpp"

#include "core/error.hpp"

#include <gtest/gtest.h>

namespace vibrotrough::measure {
namespace {

/// Four grains of 2 mm and two of 6 mm on openings of 5 mm: one small grain passes in the first cycle, two in
/// the third. Masses are the cubes of the diameters in mm.
std::vector<ScreenedSize> const sizes{{0.006, 2, 216}, {0.002, 4, 8}};
std::vector<PassedGrain> const passed{{1, 5, 0.002}, {3, 3, 0.002}, {3, 6, 0.002}};

CycleSeries on_screen() {
    CycleSeries series;
    series.x = series.z = series.vz = {0, 0, 0, 0, 0};
    series.mean_velocity = {0.1, 0.2, 0.3, 0.4};
    series.normal_force = series.tangential_force = series.flight_fraction = {0, 0, 0, 0};
    series.open.held = {6, 5, 5, 3, 3};
    series.open.held_mass = {464, 456, 456, 440, 440};
    return series;
}

Screening measured() {
    return screening(on_screen(), passed, sizes, 0.005, 0.1);
}

TEST(Screening, CountsEachSize) {
    Screening const s = measured();
    EXPECT_EQ(s.diameter, (std::vector{0.002, 0.006}));
    EXPECT_EQ(s.number, (std::vector{4.0, 2.0}));
    EXPECT_EQ(s.passed, (std::vector{3.0, 0.0}));
    EXPECT_EQ(share_curve(s, 0, 4), (std::vector{1.0, 0.75, 0.75, 0.25, 0.25}));
    EXPECT_EQ(share_curve(s, 1, 4), std::vector<double>(5, 1));
}

// Of 32 of undersize 24 passed; 8 of the remaining 440 are undersize.
TEST(Screening, EfficiencyIsTheRecoveryOfUndersize) {
    Screening const s = measured();
    EXPECT_DOUBLE_EQ(*s.efficiency, 0.75);
    EXPECT_DOUBLE_EQ(*s.passed_share, 24.0 / 464);
    EXPECT_DOUBLE_EQ(*s.undersize, 8.0 / 440);
    EXPECT_DOUBLE_EQ(*s.distance, 0.1);
    EXPECT_EQ(efficiency_curve(s, 0.005, 4), (std::vector{0.0, 0.25, 0.25, 0.75, 0.75}));
    EXPECT_TRUE(efficiency_curve(s, 0.002, 4).empty());  // nothing is smaller than the opening
}

// A quarter of the small grains stays, and all spheres as large as the opening: half between them is a third
// of the way.
TEST(Screening, TheCutSizeLiesOnAStraightLine) {
    EXPECT_NEAR(*measured().cut_size, 0.002 + 0.003 / 3, 1e-15);
    EXPECT_NEAR(*cut_size({1, 2, 4}, {0.1, 0.3, 0.7}, 5), 3, 1e-12);
    EXPECT_FALSE(cut_size({1, 2, 4}, {0.6, 0.7, 1}, 5));
    EXPECT_FALSE(cut_size({1, 2, 4}, {0.1, 0.2, 0.3}, 5));
}

TEST(Screening, HalfTimeIsBetweenTheEndsOfTwoCycles) {
    EXPECT_DOUBLE_EQ(*half_time({1, 0.75, 0.75, 0.25, 0.25}, 0.1), 0.25);
    EXPECT_FALSE(half_time({1, 1, 0.6}, 0.1));
}

TEST(Screening, AllThatAddsUpIsThere) {
    EXPECT_FALSE(size_imbalance(on_screen(), passed, sizes));
}

// The negative controls: a grain too many on the screen, one that became another, one of a size that was not
// there.
TEST(Screening, MissingAndWrongGrainsAreNamed) {
    auto fewer = passed;
    fewer.pop_back();
    EXPECT_NE(size_imbalance(on_screen(), fewer, sizes)->find("at the end of cycle 3 there are 3 grains"),
              std::string::npos);
    auto other = passed;
    other[1].size = 0.006;
    EXPECT_TRUE(size_imbalance(on_screen(), other, sizes));
    other[1].size = 0.003;
    EXPECT_NE(size_imbalance(on_screen(), other, sizes)->find("was none of this size"), std::string::npos);
}

// The last grains stay below the screen, where each dump finds them again. What a later start of the engine
// repeats replaces what the earlier one wrote.
TEST(Screening, AGrainPassesOnce) {
    auto const snapshot = [](int step, std::string const& lines, int count) {
        return "ITEM: TIMESTEP\n" + std::to_string(step) + "\nITEM: NUMBER OF ATOMS\n" +
               std::to_string(count) +
               "\nITEM: BOX BOUNDS pp pp ff\n0 1\n0 1\n0 1\nITEM: ATOMS id radius \n" + lines;
    };
    std::string const first = snapshot(0, "", 0) + snapshot(100, "5 0.001 \n", 1) +
                              snapshot(200, "7 0.001 \n", 1),
                      second = snapshot(100, "5 0.001 \n", 1) + snapshot(200, "6 0.001 \n", 1) +
                               snapshot(300, "6 0.001 \n", 1);
    auto const found = parse_passed({{"/p/passed.100.dump", second}, {"/p/passed.0.dump", first}}, 100);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].id, 5);
    EXPECT_EQ(found[1].id, 6);
    EXPECT_EQ(found[1].cycle, 2);
    EXPECT_DOUBLE_EQ(found[1].size, 0.002);
    EXPECT_THROW(parse_passed({{"/p/passed.0.dump", first + "garbage\n"}}, 100), core::InputError);
}

}  // namespace
}  // namespace vibrotrough::measure
