#include "measure/mass_flow.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

namespace vibrotrough::measure {
namespace {

constexpr double thickness = 0.0015, density = 1400;

/// A layer from `bottom` to `top` above the trough with constant solid fraction and speed, seen at ten phases
/// in bins that are fixed to the ground while the trough moves by 2 mm sin(phase).
Profiles layer(double bottom, double top, double fraction, double speed) {
    Profiles profiles{};
    for (int p = 0; p < 10; ++p) {
        double const phase = 2 * std::numbers::pi * p / 10, trough = 0.002 * std::sin(phase);
        for (int bin = -4; bin < 20; ++bin) {
            double const low = thickness * bin - trough, high = low + thickness;
            double const inside = std::max(0.0, std::min(high, top) - std::max(low, bottom));
            profiles.phase.push_back(phase);
            profiles.height.push_back(low + thickness / 2);
            profiles.solid_fraction.push_back(fraction * inside / thickness);
            profiles.velocity_x.push_back(inside > 0 ? speed : std::nan(""));
            profiles.velocity_z.push_back(0);
        }
    }
    return profiles;
}

double integral(MassFlow const& flow) {
    return thickness * std::accumulate(flow.flow.begin(), flow.flow.end(), 0.0);
}

// The integral over the height is density times fraction times height times speed, whatever the bins; and
// deep inside the layer the flow is density times fraction times speed.
TEST(MassFlow, IsThatOfAUniformLayer) {
    Profiles const one = layer(0, 0.012, 0.5, 0.2);
    std::vector<Profiles const*> const packings{&one};
    MassFlow const flow = mass_flow(packings, density, 0.95);
    // Sums of doubles of the order of 1.
    EXPECT_NEAR(integral(flow), density * 0.5 * 0.012 * 0.2, 1e-12);
    ASSERT_GT(flow.height.size(), 6u);
    EXPECT_NEAR(flow.height[0], thickness / 2, 1e-15);
    EXPECT_NEAR(flow.height[4], 4.5 * thickness, 1e-15);
    for (std::size_t slab : {2u, 3u, 4u, 5u})
        EXPECT_NEAR(flow.flow[slab], density * 0.5 * 0.2, 1e-10) << slab;
    // Bins that are cut by the surface are spread over two slabs.
    EXPECT_LE(flow.height.size(), 9u);
    for (double const width : flow.half_width) EXPECT_TRUE(std::isnan(width));
}

// Mean and interval over packings: t(0.975, 1) |a - b| / 2 for two, with t = 12.7062.
TEST(MassFlow, HasAnIntervalOverPackings) {
    Profiles const slow = layer(0, 0.012, 0.5, 0.2), fast = layer(0, 0.012, 0.5, 0.3), none{};
    std::vector<Profiles const*> const packings{&slow, &none, &fast};
    MassFlow const flow = mass_flow(packings, density, 0.95);
    double const a = density * 0.5 * 0.2, b = density * 0.5 * 0.3;
    EXPECT_NEAR(flow.flow[4], (a + b) / 2, 1e-10);
    // Six digits of t.
    EXPECT_NEAR(flow.half_width[4] / (12.7062 * (b - a) / 2), 1, 1e-6);
    EXPECT_NEAR(integral(flow), density * 0.5 * 0.012 * 0.25, 1e-12);
}

// A layer that is thrown high is found where it flies, and overlap with the trough in the lowest slab.
TEST(MassFlow, KnowsTheHeight) {
    Profiles const flying = layer(0.006, 0.009, 0.4, 0.1), sunk = layer(-0.0001, 0.003, 0.4, 0.1);
    std::vector<Profiles const*> packings{&flying};
    MassFlow const high = mass_flow(packings, density, 0.95);
    for (std::size_t slab : {0u, 1u, 2u}) EXPECT_EQ(high.flow.at(slab), 0.0);
    EXPECT_NEAR(integral(high), density * 0.4 * 0.003 * 0.1, 1e-12);
    packings = {&sunk};
    EXPECT_NEAR(integral(mass_flow(packings, density, 0.95)), density * 0.4 * 0.0031 * 0.1, 1e-12);
}

TEST(MassFlow, NeedsProfiles) {
    Profiles const none{};
    std::vector<Profiles const*> const packings{&none};
    EXPECT_TRUE(mass_flow(packings, density, 0.95).height.empty());
    EXPECT_TRUE(mass_flow({}, density, 0.95).height.empty());
}

TEST(StudentHalfWidth, IsThatOfTables) {
    std::vector<double> const values{1.0, 2.0, 3.0, 4.0};
    // s = sqrt(5/3), t(0.975, 3) = 3.182446.
    EXPECT_NEAR(student_half_width(values, 0.95).value(), 3.182446 * std::sqrt(5.0 / 3) / 2, 1e-6);
    EXPECT_FALSE(student_half_width({}, 0.95));
    EXPECT_FALSE(student_half_width(std::vector<double>{1.0}, 0.95));
}

}  // namespace
}  // namespace vibrotrough::measure
