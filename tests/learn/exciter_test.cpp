#include "learn/exciter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <gtest/gtest.h>

namespace vibrotrough::learn {
namespace {

constexpr double omega_at_1000 = 2 * std::numbers::pi * 1000 / 60;

// NetterVibration, "Formelsammlung" (netter-vibration.com): stroke s = M / m with the working moment M, twice
// the static one, F = 54.84 M (n/1000)^2 with M in cm kg, and a = 5.59 s (n/1000)^2 in g with s in cm. A
// machine of 180 kg with 150 kg of material, of which 20 % count, and a working moment of 168 cm kg: 8 mm.
// Their 54.84 is 54.831, their 5.59 is 5.5895.
TEST(Exciter, IsThatOfNetterVibration) {
    MovedMachine machine{180, 0, Exciter{1.68 / 2}, {0.2}};
    double const amplitude = amplitude_of(machine, 16, 150);
    EXPECT_NEAR(2 * amplitude, 0.008, 1e-12);
    double const n = 0.96;  // 1000/min
    EXPECT_NEAR(force_of(*machine.exciter, 16), 54.84 * 168 * n * n, 2e-4 * 54.84 * 168 * n * n);
    double const acceleration = amplitude * std::pow(n * omega_at_1000, 2) / 9.81;
    EXPECT_NEAR(acceleration, 5.59 * 0.8 * n * n, 1e-3 * acceleration);
    EXPECT_NEAR(exciter_needed(machine, 16, 150, amplitude).static_moment, 0.84, 1e-12);
    EXPECT_NEAR(exciter_of_force(force_of(*machine.exciter, 16), 16).static_moment, 0.84, 1e-12);
}

// Deca Vibrator Industries, "How much vibrator do you need": the stroke in inches is c F / W with F and W in
// pounds and c = 0.0945, 0.0530, 0.0236, 0.0059 at 864, 1152, 1728 and 3456 cycles a minute. Gravity is
// 386.09 in/s2. Their digits: 0.0945 is 0.2 % more than their formula for any speed, 1 / (14.2 (n/1000)^2).
TEST(Exciter, IsThatOfDecaVibrator) {
    constexpr double inch = 0.0254, pound = 0.45359237;
    for (auto const& [cycles, coefficient] :
         {std::pair{864.0, 0.0945}, {1152.0, 0.0530}, {1728.0, 0.0236}, {3456.0, 0.0059}}) {
        double const weight = 400 * pound, force = 1000 * pound * 9.80665;
        MovedMachine const machine{weight, 0, exciter_of_force(force, cycles / 60), {0.0}};
        double const stroke = 2 * amplitude_of(machine, cycles / 60, 0) / inch;
        EXPECT_NEAR(stroke, coefficient * 1000 / 400, 0.002 * stroke) << cycles;
        EXPECT_NEAR(stroke, 2.5 / (14.2 * std::pow(cycles / 1000, 2)), 0.002 * stroke) << cycles;
    }
}

// ROSTA, Oscillating Mountings, p. 2.22: a trough of 200 kg with 50 kg of material, half of which is coupled,
// so that 225 kg move by 12 mm at 340/min: machine factor 1.6, acceleration force 3423 N, total spring value
// 285 N/mm (of a shaker in resonance), drive capacity about 1.0 kW. As many digits as are printed.
TEST(Exciter, ReproducesRostasExample) {
    MovedMachine machine{200, 0, {}, {0.5}};
    double const frequency = 340 / 60.0, omega = 2 * std::numbers::pi * frequency;
    EXPECT_NEAR(machine.moving_mass(50), 225, 1e-12);
    Exciter const exciter = exciter_needed(machine, frequency, 50, 0.012);
    EXPECT_NEAR(force_of(exciter, frequency), 3423, 0.5);
    EXPECT_NEAR(0.012 * omega * omega / 9.81, 1.6, 0.05);
    EXPECT_NEAR(usual_drive_power(225, 0.012, frequency), 1000, 50);
    machine.spring = 285e3;
    EXPECT_NEAR(resonance_of(machine, 50), frequency, 0.002 * frequency);
    machine.exciter = exciter;
    EXPECT_THROW(amplitude_of(machine, frequency, 50), std::invalid_argument);
}

// One mass on springs: above its resonance a load makes the stroke smaller, below it larger, and far from it
// the springs do not count. At twice the resonance k = m omega^2 / 4, so that the stroke is 4/3 of that
// without springs; at half of it k = 4 m omega^2, so that it is a third.
TEST(Exciter, IsOneMassOnSprings) {
    MovedMachine machine{100, 0, Exciter{0.5}, {0.2}};
    double const free = amplitude_of(machine, 16, 0);
    EXPECT_NEAR(free, 0.005, 1e-15);
    double const stiffness = 100 * std::pow(2 * std::numbers::pi * 16, 2);
    machine.spring = stiffness / 4;
    EXPECT_NEAR(amplitude_of(machine, 16, 0), free * 4 / 3, 1e-12);
    EXPECT_LT(amplitude_of(machine, 16, 50), amplitude_of(machine, 16, 0));
    machine.spring = 4 * stiffness;
    EXPECT_NEAR(amplitude_of(machine, 16, 0), free / 3, 1e-12);
    EXPECT_GT(amplitude_of(machine, 16, 50), amplitude_of(machine, 16, 0));
}

// m x'' + k x = m_u r (phi'^2 cos(phi) + phi'' sin(phi)) with phi = a t^2 / 2, from rest to the drive's
// speed, in steps of 1/400 of its cycle: the largest |x| over the working amplitude. What is told is the
// stationary phase of that integral, so that it is a few hundredths off.
TEST(Exciter, PassesTheResonanceAsItsEquationOfMotionDoes) {
    MovedMachine machine{150, 6e5, {}, {}};
    double const frequency = 15, natural = 2 * std::numbers::pi * resonance_of(machine, 0);
    double const omega = 2 * std::numbers::pi * frequency;
    double const working = 1 / (1 - std::pow(natural / omega, 2));  // in m_u r / m
    Suspension const told = suspension_of(machine, frequency, 0, 0.005);
    for (auto const& [time, ratio] : {std::pair{usual_start, told.at_start}, {usual_stop, told.at_stop}}) {
        double const a = omega / time, step = 1 / (400 * frequency);
        double x = 0, v = 0, largest = 0;
        for (double t = 0; t < time; t += step) {
            double const phi = a * t * t / 2, w = a * t;
            v += step * (w * w * std::cos(phi) + a * std::sin(phi) - natural * natural * x);
            x += step * v;
            largest = std::max(largest, std::abs(x));
        }
        EXPECT_NEAR(ratio, largest / working, 0.05 * ratio) << time;
    }
}

// With the damping c = zeta m_s omega of a material m_s: A = m_u r / sqrt((m + a m_s - k / omega^2)^2 +
// (zeta m_s)^2). 120 kg move and 0.9 of 100 kg damp: 150 kg. The same from the equation of motion,
// m x'' + c x' + k x = m_u r omega^2 cos(omega t), in steps of a thousandth of a cycle, whose error is of
// the order of 2 pi / 1000, over 60 cycles: the transient falls as exp(-c t / 2m) = exp(-2.36 per cycle).
TEST(Exciter, IsDampedByTheMaterial) {
    MovedMachine machine{100, 0, Exciter{0.3}, {0.2, 0.05}};
    machine.damping = Uncertain{0.9, 0.1};
    EXPECT_NEAR(amplitude_of(machine, 16, 100), 0.3 / 150, 1e-15);
    EXPECT_NEAR(exciter_needed(machine, 16, 100, 0.002).static_moment, 0.3, 1e-15);
    machine.spring = 20 * std::pow(2 * std::numbers::pi * 16, 2);  // 20 kg less
    double const omega = 2 * std::numbers::pi * 16, mass = 120, damping = 0.9 * 100 * omega;
    double x = 0, v = 0, largest = 0;
    constexpr int steps = 1000, cycles = 60;
    double const dt = 1 / 16.0 / steps;
    for (int i = 0; i < cycles * steps; ++i) {
        double const force = 0.3 * omega * omega * std::cos(2 * std::numbers::pi * i / steps);
        v = (v + dt * (force - machine.spring * x) / mass) / (1 + dt * damping / mass);
        x += dt * v;
        if (i >= (cycles - 1) * steps) largest = std::max(largest, x);
    }
    EXPECT_NEAR(amplitude_of(machine, 16, 100), largest, 5e-3 * largest);
    // What is not known: the difference of the formula itself at one standard deviation.
    MovedMachine heavier = machine, damped = machine;
    heavier.added_mass.mean += 0.05;
    damped.damping->mean += 0.1;
    double const amplitude = amplitude_of(machine, 16, 100);
    EXPECT_NEAR(
        amplitude_sd(machine, 16, 100),
        std::hypot(amplitude_of(heavier, 16, 100) - amplitude, amplitude_of(damped, 16, 100) - amplitude),
        0.1 * amplitude_sd(machine, 16, 100));
}

}  // namespace
}  // namespace vibrotrough::learn
