#include "learn/plant.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough::learn {
namespace {

std::string table(std::string const& name) {
    std::ifstream const file(VIBROTROUGH_PLANT "/" + name);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

// ROSTA, Oscillating Mountings, calculation example of a free oscillating system: an empty channel of 680 kg
// with its drives, 200 kg of material, half of which is coupled, so that 780 kg move; working torque of both
// drives 600 kg cm, 960 1/min: stroke 8.8 mm empty and 7.7 mm in operation, centrifugal force 30319 N,
// machine factor 4.0, and with a natural frequency of 2.7 Hz a degree of isolation of 97 %. As many digits as
// are printed.
TEST(Plant, ReproducesRostasFreeOscillatingSystem) {
    constexpr double frequency = 960 / 60.0;
    double const omega = 2 * std::numbers::pi * frequency;
    MovedMachine machine{680, 0, Exciter{6.0 / 2}, {0.5}};
    EXPECT_NEAR(machine.moving_mass(200), 780, 1e-12);
    EXPECT_NEAR(2e3 * amplitude_of(machine, frequency, 0), 8.8, 0.05);
    double const amplitude = amplitude_of(machine, frequency, 200);
    EXPECT_NEAR(2e3 * amplitude, 7.7, 0.05);
    EXPECT_NEAR(force_of(*machine.exciter, frequency), 30319, 1);
    EXPECT_NEAR(omega * omega * amplitude / 9.81, 4.0, 0.05);
    machine.spring = 780 * std::pow(2 * std::numbers::pi * 2.7, 2);
    Suspension const found = suspension_of(machine, frequency, 200, amplitude);
    EXPECT_NEAR(found.loaded, 2.7, 1e-12);
    EXPECT_NEAR(found.isolation, 0.97, 0.005);
    // f_n = 5 / sqrt(sag in cm), as makers write it for a mass that wholly moves: here 880 kg sag and 780 kg
    // swing.
    EXPECT_NEAR(found.loaded, 5 / std::sqrt(100 * found.sag * 780 / 880), 0.01 * found.loaded);
    EXPECT_NEAR(found.force, machine.spring * amplitude, 1e-9);
    EXPECT_GT(found.empty, found.loaded);
}

TEST(Plant, SpringsThatIsolateNothingAreRefused) {
    MovedMachine machine{100, 0, Exciter{0.5}, {0.2}};
    EXPECT_THROW(suspension_of(machine, 16, 0, 0.005), std::invalid_argument);
    machine.spring = 100 * std::pow(2 * std::numbers::pi * 12, 2);
    EXPECT_THROW(suspension_of(machine, 16, 0, 0.005), std::invalid_argument);
}

// x'' + omega_n^2 x = phi'^2 cos(phi) with phi = a t^2 / 2, in units of m_u r / m, which is the amplitude far
// above the resonance; integrated by the midpoint rule in 20,000 steps. Tolerance: 10 %, because the working
// speed is only six times the resonance and not infinitely far from it.
TEST(Plant, PassesItsResonanceAsTheEquationOfMotionSays) {
    constexpr double natural = 2.7, frequency = 16, time = 4;
    double const own = 2 * std::numbers::pi * natural, a = 2 * std::numbers::pi * frequency / time;
    constexpr int steps = 20000;
    double const dt = time / steps;
    double x = 0, v = 0, largest = 0;
    for (int i = 0; i < steps; ++i) {
        double const t = (i + 0.5) * dt, turns = a * t;
        v += dt * (turns * turns * std::cos(a * t * t / 2) - own * own * x);
        x += dt * v;
        largest = std::max(largest, std::abs(x));
    }
    double const expected = passage_through_resonance(natural, frequency, time);
    EXPECT_NEAR(expected, largest, 0.1 * largest);
}

// Each motor of the table has force = static moment times omega^2; read_motors() checks it to 5 %.
TEST(Plant, MotorsAreChosen) {
    auto const motors = read_motors(table("motors.csv"), "motors.csv");
    // 2 x 10 kN at 78 %, of six poles: F = M omega^2 at 1000 1/min.
    double const omega = 2 * std::numbers::pi * 1000 / 60;
    auto const found = choose_motors(motors, 0.78 * 2 * 10000 / (omega * omega), 970 / 60.0);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->motor.rpm, 1000);
    EXPECT_NEAR(found->motor.force, 10000, 1e-9);
    EXPECT_NEAR(found->setting, 0.78, 1e-3);
    EXPECT_FALSE(found->is_converted);
    EXPECT_TRUE(choose_motors(motors, 0.5, 9)->is_converted);  // 540 1/min
    EXPECT_FALSE(choose_motors(motors, 100, 16));
    EXPECT_FALSE(choose_motors(motors, 0.01, 60));
}

TEST(Plant, ATableThatContradictsItselfIsRefused) {
    std::string const head = "rpm,static_moment_kg_mm,force_kN,power_kW\n";
    EXPECT_EQ(read_motors(head + "1000,912,10,0.75\n", "own.csv").size(), 1U);
    EXPECT_THROW(read_motors(head + "1000,456,10,0.75\n", "own.csv"), core::InputError);
    EXPECT_THROW(read_motors("rpm,force_kN\n1000,10\n", "own.csv"), core::InputError);
}

// What stands in for numbers that nobody measured must be a range that the models may be asked about.
TEST(Plant, MaterialsHaveRangesAndSources) {
    auto const materials = read_materials(table("materials.csv"), "materials.csv");
    EXPECT_GE(materials.size(), 15U);
    for (BulkMaterial const& one : materials) {
        EXPECT_LT(one.bulk_density.low, one.bulk_density.high) << one.name;
        EXPECT_LT(one.friction.low, one.friction.high) << one.name;
        EXPECT_LT(one.rolling_friction.high, 0.5) << one.name;
        EXPECT_FALSE(one.source.empty()) << one.name;
        bool const is_known = one.kind.empty() || std::ranges::find(grain_kinds(), one.kind,
                                                                    &GrainKind::name) != grain_kinds().end();
        EXPECT_TRUE(is_known) << one.name;
        EXPECT_EQ(one.kind == "powder", one.size.high < largest_powder) << one.name;
    }
}

// ROSTA's crank conveyor is a crank's, and the machine of the issue an unbalance motor's: 30 mm at 546 1/min
// is neither.
TEST(Plant, KindsOfDrivesHaveTheirLimits) {
    auto const kinds = read_drives(table("drives.csv"), "drives.csv");
    auto const builds = [&](std::string const& name, double stroke, double rpm) {
        auto const& kind = *std::ranges::find(kinds, name, &DriveKind::name);
        return kind.builds({rpm / 60, stroke / 2, 0.5, 0});
    };
    EXPECT_TRUE(builds("crank", 0.024, 340));
    EXPECT_TRUE(builds("unbalance motors", 0.008, 1000));
    EXPECT_FALSE(builds("unbalance motors", 0.03, 546));
    EXPECT_FALSE(builds("crank", 0.03, 546));
    EXPECT_TRUE(builds("magnet", 0.001, 3000));
}

}  // namespace
}  // namespace vibrotrough::learn
