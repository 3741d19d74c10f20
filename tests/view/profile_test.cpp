#include "view/profile.hpp"

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace vibrotrough::view {
namespace {

constexpr double area = 0.03 * 0.02;

GrainFrame frame_of(std::vector<std::array<float, 3>> const& centres, float radius) {
    GrainFrame frame;
    frame.box = {0.0, 0.03, 0.0, 0.02, 0.0, 1.0};
    for (auto const& centre : centres) {
        frame.id.push_back(static_cast<int>(frame.id.size()) + 1);
        frame.position.insert(frame.position.end(), centre.begin(), centre.end());
        frame.radius.push_back(radius);
    }
    frame.velocity.assign(3 * centres.size(), 0.0F);
    return frame;
}

// Two slabs of one radius each: half a sphere in each, 2/3 pi r^3 over 0.03 * 0.02 * r.
TEST(Profile, OfOneSphereIsTwoHalves) {
    double const r = 0.0015;
    GrainFrame const frame = frame_of({{0.01F, 0.01F, 0.0015F}}, 0.0015F);
    Profile const profile = profile_of(frame, {0.25F, 0.0F, 0.0F}, 0.0, area);
    double const half = 2.0 / 3.0 * std::numbers::pi * r * r / (0.03 * 0.02);
    ASSERT_GE(profile.height.size(), 2u);
    // Single precision of the radius, cubed: 2e-7.
    EXPECT_NEAR(profile.solid_fraction[0], half, 1e-6 * half);
    EXPECT_NEAR(profile.solid_fraction[1], half, 1e-6 * half);
    EXPECT_NEAR(profile.height[0], r / 2, 1e-9);
    EXPECT_NEAR(profile.velocity[0], 0.25, 1e-12);
}

// The volumes and momenta of the slices, summed over the slabs, equal those of the grains.
TEST(Profile, LosesNoVolumeAndNoMomentum) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0.0F, 1.0F);
    std::vector<std::array<float, 3>> centres;
    std::vector<float> velocity;
    for (int i = 0; i < 300; ++i) {
        centres.push_back({0.03F * unit(random), 0.02F * unit(random), 0.001F + 0.02F * unit(random)});
        velocity.insert(velocity.end(), {unit(random) - 0.3F, unit(random), unit(random)});
    }
    GrainFrame frame = frame_of(centres, 0.0015F);
    for (std::size_t i = 0; i < frame.radius.size(); i += 2) frame.radius[i] = 0.0012F;
    Profile const profile =
        profile_of(frame, velocity, 0.0004, area);  // some grains are pressed into the trough
    double const slab = 0.03 * 0.02 * 2 * profile.height[0];
    double volume = 0, momentum = 0, grains = 0, moved = 0;
    for (std::size_t i = 0; i < profile.height.size(); ++i) {
        volume += slab * profile.solid_fraction[i];
        if (profile.solid_fraction[i] > 0) momentum += slab * profile.solid_fraction[i] * profile.velocity[i];
    }
    for (std::size_t i = 0; i < frame.grains(); ++i) {
        double const sphere = 4.0 / 3.0 * std::numbers::pi * std::pow(frame.radius[i], 3);
        grains += sphere;
        moved += sphere * velocity[3 * i];
    }
    EXPECT_NEAR(volume, grains, 1e-10 * grains);
    EXPECT_NEAR(momentum, moved, 1e-10 * grains);
}

TEST(Profile, BelowALayerInFlightIsNothing) {
    Profile const profile =
        profile_of(frame_of({{0.01F, 0.01F, 0.01F}}, 0.001F), {0.1F, 0.0F, 0.0F}, 0.002, area);
    EXPECT_EQ(profile.solid_fraction[0], 0.0);
    EXPECT_TRUE(std::isnan(profile.velocity[0]));
    EXPECT_GT(profile.solid_fraction.back(), 0.0);
}

TEST(Profile, OfNoGrainIsEmptyAndOfAFarGrainIsBounded) {
    EXPECT_TRUE(profile_of(GrainFrame{}, {}, 0.0, area).height.empty());
    EXPECT_LE(
        profile_of(frame_of({{0.01F, 0.01F, 500.0F}}, 0.001F), {0.1F, 0.0F, 0.0F}, 0.0, area).height.size(),
        401u);
}

}  // namespace
}  // namespace vibrotrough::view
