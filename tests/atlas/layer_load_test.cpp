#include "atlas/layer_load.hpp"

#include "atlas/tables.hpp"
#include "core/csv.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace vibrotrough::atlas {
namespace {

/// A layer in the middle of the atlas.
Place middle() {
    Place place;
    for (SurfaceInput const& input : inputs()) place.push_back((input.low + input.high) / 2);
    return place;
}

// P = F v, averaged over a cycle: a damping of c m omega acts with c m omega v, and the mean of v^2 is
// (omega A)^2 / 2, so that P / m = c omega^3 A^2 / 2. Tolerance: rounding.
TEST(LayerLoad, PowerIsThatOfTheDamping) {
    LayerLoad const load{{0.3, 0.02}, {0.2, 0.05}};
    double const omega = 2 * std::numbers::pi * 16, amplitude = 0.004;
    auto const [power, half_width] = power_per_mass(load, amplitude, 16).value();
    EXPECT_NEAR(power, 0.2 * omega * std::pow(omega * amplitude, 2) / 2, 1e-9 * power);
    EXPECT_NEAR(half_width, power / 4, 1e-9 * power);
}

// Outside of the simulated layers the surface of the damping may be negative; a layer never drives its
// trough.
TEST(LayerLoad, NoPowerIsToldWhereTheDampingIsNegative) {
    EXPECT_FALSE(power_per_mass({{0.3, 0.02}, {-0.01, 0.05}}, 0.004, 16));
}

// Each layer is met within the half-width there and its own, but for the share that 95 % intervals leave out.
TEST(LayerLoad, TheDrawsBelongToTheLayers) {
    auto const added_mass = read_column(layers_table, "layers.csv", "added_mass");
    auto const damping = read_column(layers_table, "layers.csv", "damping");
    ASSERT_EQ(added_mass.size(), damping.size());
    ASSERT_GE(added_mass.size(), 96U);
    int outside = 0;
    auto const count = [&](SurfacePoint const& layer, Bounded const& found) {
        outside += std::abs(layer.efficiency - found.value) > std::hypot(layer.half_width, found.half_width);
    };
    for (std::size_t i = 0; i < added_mass.size(); ++i) {
        LayerLoad const load = load_at(added_mass[i].place);
        count(added_mass[i], load.added_mass);
        count(damping[i], load.damping);
    }
    EXPECT_LE(outside, static_cast<int>(added_mass.size()) / 10);
}

// A layer that is thrown high hardly feels the trough as a mass; one that is hardly thrown moves with it in
// part (validation/atlas: 0.2 to 0.6 below a throw number of 1, below 0.05 from 3 on).
TEST(LayerLoad, LessMassMovesAlongTheHigherTheLayerIsThrown) {
    Place place = middle();
    double last = 1;
    for (double const throw_number : {0.9, 1.5, 2.0, 2.5, 3.1}) {
        place[throw_number_input] = throw_number;
        auto const [value, half_width] = load_at(place).added_mass;
        EXPECT_LT(value, last) << throw_number;
        EXPECT_LT(half_width, 0.05) << throw_number;
        last = value;
    }
    EXPECT_LT(last, 0.05);
}

TEST(LayerLoad, ATableWithoutTheColumnIsRefused) {
    EXPECT_THROW(read_column("case,throw_number\na,1\n", "layers.csv", "damping"), core::CsvError);
}

}  // namespace
}  // namespace vibrotrough::atlas
