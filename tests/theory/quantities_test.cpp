#include "theory/quantities.hpp"

#include "random_number.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace vibrotrough::theory {
namespace {

using std::numbers::pi;

Conveyor any_conveyor() {
    Conveyor c{};
    double const mu = between(0.1, 0.8);
    c.point = {between(0.2, 3.2), std::tan(between(5, 70) * pi / 180), between(-0.8, 0.8) * mu, mu};
    if (*rc::gen::arbitrary<bool>()) c.static_friction = mu * between(1, 1.5);
    if (*rc::gen::arbitrary<bool>()) c.restitution = between(0, 0.4);
    if (*rc::gen::arbitrary<bool>()) c.air_drag = between(0, 0.2);
    if (*rc::gen::arbitrary<bool>()) c.along_ratio = between(0.5, 1.5), c.along_phase = between(-1, 1);
    if (*rc::gen::arbitrary<bool>()) c.normal = {{*rc::gen::inRange(2, 6), between(0, 0.3), between(-3, 3)}};
    if (*rc::gen::arbitrary<bool>()) c.along = {{*rc::gen::inRange(2, 6), between(0, 0.3), between(-3, 3)}};
    if (*rc::gen::arbitrary<bool>()) c.wall_friction = between(0, 0.4), c.height_over_width = between(0, 1);
    return c;
}

// Over a period the kinetic energy does not change: work of the trough = friction + impact + drag losses +
// potential energy, for every combination of the models. Tolerance: the quadrature (1e-12) and the
// periodicity of the state (1e-11 in velocity); the energy of rebounds below slowest_rebound = 1e-6 is its
// square.
RC_GTEST_PROP(EnergyBalance, WorkOfTheTroughIsLossesAndLift, ()) {
    Conveyor const conveyor = any_conveyor();
    ConveyorMotion const motion = solve(conveyor);
    RC_PRE(motion.motion.converged);
    EnergyBalance const energy = energy_balance(motion);
    RC_LOG() << "Gamma " << conveyor.point.throw_number << " tan(beta) " << conveyor.point.tan_vibration_angle
             << " tan(alpha) " << conveyor.point.tan_inclination << " mu " << conveyor.point.friction
             << " mu_s " << conveyor.static_friction << " e " << conveyor.restitution << " drag "
             << conveyor.air_drag << " mode " << motion.motion.mode << " first "
             << motion.pieces.front().along_velocity << " n " << motion.motion.period_cycles << " defect "
             << energy.residual();
    RC_ASSERT(std::abs(energy.residual()) < 1e-9 * motion.motion.period_cycles);
    RC_ASSERT(energy.friction_loss >= -1e-12);
    RC_ASSERT(energy.impact_loss >= 0);
}

// The same balance for the plastic point mass over its whole range. Above Gamma = 3.297 the mass takes off
// again at once, so that a period may last thousands of cycles, most of them in flight. Tolerance: 1e-9 of
// the largest energy; at 1e5 rad a time is rounded to 1e-11, which changes a velocity by as much. Beside 1 /
// Gamma, the energy that gravity has in one cycle.
RC_GTEST_PROP(EnergyBalance, HoldsForThePlasticMassWithFlightsOfAnyLength, ()) {
    double const mu = std::pow(10, between(-3, 1));
    Conveyor conveyor{};
    conveyor.point = {std::pow(10, between(-1, 1.99)), std::pow(10, between(-2, 1)), between(-0.9, 0.9) * mu,
                      mu};
    ConveyorMotion const motion = solve(conveyor);
    RC_PRE(motion.motion.converged);
    EnergyBalance const energy = energy_balance(motion);
    PointMass const& p = conveyor.point;
    RC_LOG() << "Gamma " << p.throw_number << " tan(beta) " << p.tan_vibration_angle << " tan(alpha) "
             << p.tan_inclination << " mu " << p.friction << " mode " << motion.motion.mode << " cycles "
             << motion.motion.period_cycles << " work " << energy.trough_work << " friction "
             << energy.friction_loss << " impacts " << energy.impact_loss << " lift " << energy.lift;
    double const scale = std::max({energy.trough_work, energy.friction_loss, energy.impact_loss,
                                   std::abs(energy.lift), 1 / p.throw_number});
    RC_ASSERT(std::abs(energy.residual()) < 1e-9 * scale);
    std::size_t flights = 0;
    for (Phase const& phase : motion.motion.phases) flights += phase.kind == PhaseKind::flight ? 1 : 0;
    RC_ASSERT(motion.impacts.size() == flights);
    double moved = 0;
    for (Piece const& piece : motion.pieces) moved += piece.displacement;
    double const length = motion.pieces.back().end - motion.pieces.front().start;
    RC_ASSERT(std::abs(moved / length - motion.motion.velocity_efficiency) <
              1e-9 * (1 + std::abs(motion.motion.velocity_efficiency)));
}

// A flight of some 30 cycles, with which the energies of a part of it were shown: all of them were 0.
TEST(EnergyBalance, DoesNotEndWithinAFlight) {
    Conveyor conveyor{};
    conveyor.point = {100, 0.25, 0.05, 0.3};
    ConveyorMotion const motion = solve(conveyor);
    EXPECT_EQ(motion.half_width, 0) << "the motion is periodic";
    EXPECT_GT(motion.motion.flight_number, 30);
    EngineerQuantities const q = engineer_quantities(motion, {.amplitude = 4.575});
    EXPECT_GT(q.impact_energy, 0);
    EXPECT_GT(q.trough_work, q.impact_energy);
    EXPECT_GT(q.impact_speed, 0);
    EXPECT_GT(q.largest_normal_force, 0);
    EXPECT_NEAR(q.impacts_per_cycle * motion.motion.period_cycles, 1, 1e-9);
}

// Where no period is found, the energies are those of the cycles of which the speed is the mean: the balance
// closes with the energy of the mass at their end minus that at their begin, E = u^2 / 2 + g x + (w^2 / 2 + g
// y), in the units of the two directions. Tolerance: as above, and 1e-12 for each rebound below
// slowest_rebound.
RC_GTEST_PROP(EnergyBalance, HoldsOverTheCyclesThatAreAveraged, ()) {
    double const mu = between(0.1, 0.8);
    Conveyor conveyor{};
    conveyor.point = {std::pow(10, between(0.5, 1.99)), std::tan(between(5, 70) * pi / 180),
                      between(-0.8, 0.8) * mu, mu};
    conveyor.restitution = between(0.3, 0.95);
    ConveyorMotion const motion = solve(conveyor);
    RC_PRE(motion.motion.outcome == Outcome::unsettled);
    double const tangent = conveyor.point.tan_vibration_angle, weight = 1 / conveyor.point.throw_number;
    double const along = 1 / (1 + tangent * tangent), normal = 1 - along;
    double const gravity = conveyor.point.tan_inclination * tangent * weight;
    auto const samples = trace(motion, 2);
    auto const stored = [&](TraceSample const& s) {
        return along * (s.mass_vx * s.mass_vx / 2 + gravity * std::sin(s.t)) +
               normal * (s.mass_vy * s.mass_vy / 2 + weight * (std::sin(s.t) + s.gap));
    };
    double const cycles = (samples[1].t - samples[0].t) / (2 * pi);
    double const change = (stored(samples[1]) - stored(samples[0])) / cycles;
    EnergyBalance const energy = energy_balance(motion);
    RC_LOG() << "Gamma " << conveyor.point.throw_number << " tan(beta) " << tangent << " tan(alpha) "
             << conveyor.point.tan_inclination << " mu " << mu << " e " << conveyor.restitution << " cycles "
             << cycles << " work " << energy.trough_work << " change " << change << " residual "
             << energy.residual() << " impacts " << motion.impacts.size();
    double const scale =
        std::max({std::abs(energy.trough_work), energy.impact_loss, std::abs(energy.lift), 1.0});
    RC_ASSERT(std::abs(energy.residual() - change) < 1e-9 * scale);
    RC_ASSERT(motion.impacts.size() >= 8u);
}

// The trace agrees with the motion: its slip velocity integrates to eta, and the gap is open during flight.
// Tolerance: the trapezoidal rule with 20000 samples and a jump at each impact.
TEST(Trace, IntegratesToTheEfficiency) {
    Conveyor conveyor{};
    conveyor.point = {2, 0.5, -0.05, 0.23};
    ConveyorMotion const motion = solve(conveyor);
    auto const samples = trace(motion, 20001);
    double slip = 0;
    for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
        auto const &a = samples[i], &b = samples[i + 1];
        slip += (b.t - a.t) * (a.mass_vx - a.trough_vx + b.mass_vx - b.trough_vx) / 2;
    }
    EXPECT_NEAR(slip / (2 * pi), motion.motion.velocity_efficiency, 1e-3);
    EXPECT_NEAR(samples.back().displacement / (2 * pi), motion.motion.velocity_efficiency, 1e-9);
    EXPECT_NEAR(samples.front().t, std::asin(0.5), 1e-9);  // take-off at arcsin(1/Gamma)
    for (auto const& s : samples) {
        if (s.kind == PhaseKind::flight) {
            EXPECT_EQ(s.normal_force, 0);
        } else {
            EXPECT_EQ(s.gap, 0);
            EXPECT_LE(std::abs(s.tangential_force), 0.23 * 0.5 * s.normal_force + 1e-12);  // Coulomb
        }
    }
}

// The motion at any time equals that of the first period, displaced by the distance conveyed per period.
TEST(Trace, RepeatsItselfFromPeriodToPeriod) {
    Conveyor conveyor{};
    conveyor.point = {.throw_number = 2.5, .tan_vibration_angle = 0.5, .friction = 0.23};
    ConveyorMotion const motion = solve(conveyor);
    auto const samples = trace(motion, 500);
    double const period = samples.back().t - samples.front().t, travel = samples.back().displacement;
    for (int const periods : {-3, 0, 1, 40}) {
        for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
            TraceSample const again = sample(motion, samples[i].t + periods * period);
            // Rounding of t after 40 periods: 250 * 2e-16, times velocities of order 1 to 10.
            EXPECT_NEAR(again.displacement, samples[i].displacement + periods * travel, 1e-11);
            EXPECT_NEAR(again.gap, samples[i].gap, 1e-11);
            if (again.kind != samples[i].kind) continue;  // at the very end of a phase
            EXPECT_NEAR(again.mass_vx, samples[i].mass_vx, 1e-11);
        }
    }
    EXPECT_THROW(sample(ConveyorMotion{}, 0.0), std::invalid_argument);
}

// omega^2 = Gamma g cos(alpha) / (r sin(beta)); v = eta omega r cos(beta); mass flow = density H W v. The
// mean normal force is the weight: the mean over the cycle of N plus impulses = g cos(alpha). Tolerance:
// rounding; the trapezoidal rule.
TEST(Quantities, AreInSiUnits) {
    Conveyor conveyor{};
    conveyor.point = {2, std::tan(pi / 6), 0, 0.3};
    ConveyorMotion const motion = solve(conveyor);
    Machine const machine{
        .amplitude = 0.006, .gravity = 9.81, .bulk_density = 800, .layer_height = 0.012, .layer_width = 0.2};
    EngineerQuantities const q = engineer_quantities(motion, machine);
    double const omega = std::sqrt(2 * 9.81 / (0.006 * 0.5));
    EXPECT_NEAR(q.frequency, omega / (2 * pi), 1e-12);
    double const speed = motion.motion.velocity_efficiency * omega * 0.006 * std::cos(pi / 6);
    EXPECT_NEAR(q.conveying_speed, speed, 1e-12);
    EXPECT_NEAR(q.mass_flow.value(), 800 * 0.012 * 0.2 * speed, 1e-10);
    EXPECT_NEAR(q.power_per_area.value(), 800 * 0.012 * q.mean_power, 1e-10);
    EXPECT_NEAR(q.stroke, 0.012, 1e-15);
    EXPECT_NEAR(q.mean_power, q.trough_work * q.frequency, 1e-12);
    EXPECT_NEAR(q.impacts_per_cycle, 1, 1e-9);
    EXPECT_NEAR(q.trough_work, q.friction_energy + q.impact_energy,
                1e-9);  // level trough: the potential energy does not change
    double impulse = motion.impacts[0].approach;
    auto const samples = trace(motion, 20001);
    for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
        impulse +=
            (samples[i + 1].t - samples[i].t) * (samples[i].normal_force + samples[i + 1].normal_force) / 2;
    }
    EXPECT_NEAR(impulse / (2 * pi), 1 / 2.0, 1e-3);  // in omega^2 r sin(beta): 1/Gamma
    EXPECT_GT(q.impact_speed, q.normal_impact_speed * 0.999);
}

// The trough carries the weight of a resting mass at any vibration angle: N = g cos(alpha) and more while it
// accelerates upwards. The square of the tangent underflows.
TEST(Quantities, TheWeightDoesNotVanishWithTheVibrationAngle) {
    for (double const tangent : {1e-3, 1e-160, 1e-300}) {
        Conveyor conveyor{};
        conveyor.point = {4 * tangent, tangent, 0, 0.3};  // K = 4
        EngineerQuantities const q =
            engineer_quantities(solve(conveyor), {.amplitude = 0.006, .gravity = 9.81});
        // At rest N = g + omega^2 r sin(beta), of which K = 4 is the factor to g. It was 6e-4 too low where
        // the largest force lay between two samples.
        EXPECT_NEAR(q.largest_normal_force, 9.81 * (1 + 4 * tangent), 1e-9);
        EXPECT_NEAR(q.largest_tangential_force, 0.3 * q.largest_normal_force, 1e-9);
    }
}

// Without a layer there is no mass flow, which is not the same as a mass flow of zero.
TEST(Quantities, WithoutALayerThereIsNoMassFlow) {
    Conveyor conveyor{};
    conveyor.point = {2, std::tan(pi / 6), 0, 0.3};
    ConveyorMotion const motion = solve(conveyor);
    EngineerQuantities const q = engineer_quantities(motion, {.amplitude = 0.006, .bulk_density = 800});
    EXPECT_FALSE(q.mass_flow);
    EXPECT_FALSE(q.power_per_area);
    for (NamedQuantity const& one : listed(q))
        EXPECT_EQ(std::string(one.name).find("mass_flow"), std::string::npos);
}

// K = omega^2 r / g with omega = 2 pi f and r = stroke / 2. Tolerance: rounding.
// Two ways to the power: the work of the trough, and what is lost and lifted. Tolerance: a period is found to
// 1e-9 and the energies are integrated to 1e-12; the natural unit of a power is (omega r)^2 times frequency.
RC_GTEST_PROP(ImpactAndPower, AreThoseOfAllQuantities, ()) {
    double const mu = between(0.05, 1);
    Conveyor conveyor{};
    conveyor.point = {between(0.2, 5), std::tan(between(5, 70) * pi / 180), between(-0.9, 0.9) * mu, mu};
    Machine const machine{between(0.5e-3, 15e-3)};
    ConveyorMotion const motion = solve(conveyor);
    RC_PRE(motion.motion.converged);
    EngineerQuantities const expected = engineer_quantities(motion, machine);
    ImpactAndPower const found = impact_and_power(motion, machine);
    double const speed = expected.angular_frequency * machine.amplitude;
    RC_ASSERT(std::abs(found.impact_speed - expected.impact_speed) <= 1e-12 * speed);
    RC_ASSERT(std::abs(found.mean_power - expected.mean_power) <= 1e-8 * speed * speed * expected.frequency);
}

TEST(Inputs, TakeFrequencyAndStroke) {
    auto const inputs = [](Input length, double value) {
        Inputs in;
        in.set(Input::frequency_hz, 15);
        in.set(Input::tan_vibration_angle, 0.5);
        in.set(Input::friction, 0.3);
        in.set(length, value);
        return in;
    };
    double const omega = 2 * pi * 15, k = omega * omega * 0.006 / 9.81;
    for (Inputs const& in : {inputs(Input::amplitude_m, 0.006), inputs(Input::stroke_mm, 12)}) {
        EXPECT_FALSE(in.incomplete()) << *in.incomplete();
        EXPECT_TRUE(in.plastic());
        EXPECT_NEAR(machine_number(in.point()), k, 1e-13 * k);
        EXPECT_NEAR(in.velocity_scale().value(), omega * 0.006 / std::hypot(1, 0.5), 1e-14);
    }
    Inputs wrong = inputs(Input::amplitude_m, 0.006);
    wrong.set(Input::stroke_mm, 12);
    EXPECT_TRUE(wrong.incomplete()) << "two amplitudes";
    wrong = inputs(Input::amplitude_m, 0.006);
    wrong.set(Input::throw_number, 2);
    EXPECT_TRUE(wrong.incomplete()) << "three numbers of the drive";
    wrong.clear(Input::frequency_hz);
    EXPECT_FALSE(wrong.incomplete()) << "the amplitude only gives the speed";
    wrong = inputs(Input::amplitude_m, 0.006);
    wrong.clear(Input::amplitude_m);
    EXPECT_TRUE(wrong.incomplete()) << "a frequency without an amplitude";
    EXPECT_THROW(inputs(Input::stroke_mm, 0).point(), std::invalid_argument);
}

}  // namespace
}  // namespace vibrotrough::theory
