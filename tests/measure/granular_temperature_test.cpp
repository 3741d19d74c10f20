#include "measure/granular_temperature.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace vibrotrough::measure {
namespace {

constexpr int steps = 1000;
constexpr double grain_mass = 1e-5;

/// A snapshot at step 300 k and the energy of its grains, of which each half bin has `count`; all move with a
/// mean velocity that grows with the height, and with random velocities of this deviation.
struct MadeLayer {
    std::vector<Snapshot> snapshots;
    PhaseSeries phases;
};

MadeLayer made_layer(int count, double deviation, double gradient) {
    constexpr int bins = 10, cycles = 60;
    std::mt19937 random(7);
    std::normal_distribution<double> velocity(0, deviation);
    MadeLayer made;
    made.phases.x.resize(static_cast<std::size_t>(PhaseSeries::per_cycle * cycles));
    made.phases.energy_translation.resize(made.phases.x.size());
    for (long step = 300; step <= cycles * steps; step += 300) {
        Snapshot snapshot{step, {}};
        double energy = 0;
        for (int bin = 0; bin < bins; ++bin) {
            double sum_x = 0, sum_z = 0;
            for (int i = 0; i < count; ++i) {
                double const mean = gradient * (bin / 2);  // the same in both bins of a slab
                double const x = mean + velocity(random), y = velocity(random), z = 0.5 + velocity(random);
                energy += grain_mass / 2 * (x * x + y * y + z * z);
                sum_x += x;
                sum_z += z;
            }
            snapshot.bins.push_back({bin * 0.0015, static_cast<double>(count), 500, {}});
            snapshot.bins.back().means = {count > 0 ? sum_x / count : 0, count > 0 ? sum_z / count : 0};
        }
        made.snapshots.push_back(std::move(snapshot));
        made.phases.energy_translation[static_cast<std::size_t>(step / 10 - 1)] = energy;
    }
    return made;
}

double temperature_of(MadeLayer const& made, int count, int bins_per_slab = 2) {
    return granular_temperature(made.snapshots, made.phases,
                                {10 * count * grain_mass, steps, 10, 60, bins_per_slab})
        .value();
}

// Of grains with normal velocities of the deviation s it is s^2, however few there are in a slab, and
// whatever the mean motion is. The tolerance is three standard errors: sqrt(2 / 3 N) of 170 snapshots.
TEST(GranularTemperature, IsTheVarianceAboutTheMeanAtEachHeight) {
    for (int const count : {1, 5, 40})
        for (double const gradient : {0.0, 0.4}) {
            double const error = std::sqrt(2.0 / 3 / (170.0 * 10 * count));
            EXPECT_NEAR(temperature_of(made_layer(count, 0.1, gradient), count) / 0.01, 1, 3.5 * error)
                << count << ' ' << gradient;
        }
    EXPECT_NEAR(temperature_of(made_layer(5, 0, 0.4), 5), 0, 1e-12);
}

// The negative control: with the mean of the whole layer in place of that at each height, shear counts, too.
TEST(GranularTemperature, IsNotThatAboutTheMeanOfTheLayer) {
    EXPECT_GT(temperature_of(made_layer(40, 0.1, 0.4), 40, 10), 0.05);
}

TEST(GranularTemperature, NeedsSnapshots) {
    MadeLayer const made = made_layer(5, 0.1, 0);
    EXPECT_FALSE(granular_temperature({}, made.phases, {1, steps, 0, 60, 2}));
    EXPECT_FALSE(granular_temperature(made.snapshots, made.phases, {1, steps, 60, 60, 2}));
}

}  // namespace
}  // namespace vibrotrough::measure
