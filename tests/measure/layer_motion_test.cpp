#include "measure/layer_motion.hpp"

#include "measure/layer_mode.hpp"
#include "point_mass_phases.hpp"

#include <algorithm>
#include <numbers>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

// A point mass that moves exactly according to the theory serves as a layer for which all quantities are
// known.
namespace vibrotrough::measure {
namespace {

using std::numbers::pi;
constexpr double interval = 2 * pi / 100;

std::string name(theory::PointMass const& p) {
    return fmt::format("Gamma {}, tan beta {}, tan alpha {}, mu {}", p.throw_number, p.tan_vibration_angle,
                       p.tan_inclination, p.friction);
}

theory::Phase longest_flight(theory::Motion const& motion) {
    theory::Phase longest{};
    for (theory::Phase const& phase : motion.phases) {
        bool const flies = phase.kind == theory::PhaseKind::flight;
        if (flies && phase.end - phase.start > longest.end - longest.start) longest = phase;
    }
    return longest;
}

/// Whether every phase is long enough to be recognised and every slide is faster than the threshold for rest.
bool is_clear(theory::ConveyorMotion const& theory) {
    for (theory::Phase const& phase : theory.motion.phases) {
        if (phase.end - phase.start < 5 * interval) return false;
    }
    auto const samples = theory::trace(theory, 2001);
    for (theory::Phase const& phase : theory.motion.phases) {
        if (phase.kind == theory::PhaseKind::rest || phase.kind == theory::PhaseKind::flight) continue;
        double fastest = 0;
        for (theory::TraceSample const& s : samples) {
            if (s.t < phase.start || s.t > phase.end) continue;
            fastest = std::max(fastest, std::abs(s.mass_vx - s.trough_vx));
        }
        if (fastest < 3 * rest_slip) return false;
    }
    return true;
}

std::vector<theory::PointMass> grid() {
    std::vector<theory::PointMass> points;
    for (double const gamma : {0.3, 0.5, 0.7, 0.9, 1.1, 1.5, 1.7, 2.0, 2.5, 2.8, 3.5, 4.0, 4.6, 5.0}) {
        for (double const tan_beta : {0.25, 1.0}) {
            for (double const mu : {0.15, 0.35, 0.8}) {
                for (double const tan_alpha : {-0.1, 0.0, 0.05})
                    points.push_back({gamma, tan_beta, tan_alpha, mu});
            }
        }
    }
    return points;
}

TEST(LayerMotion, GivesBackTheTheorysModes) {
    std::set<std::string> modes;
    int clear = 0;
    for (theory::PointMass const& point : grid()) {
        PointMassPhases mass(point);
        if (!mass.theory.motion.converged || !is_clear(mass.theory)) continue;
        ++clear;
        theory::Motion const& wanted = mass.theory.motion;
        LayerMotion const found = layer_motion(mass.series(2 + 4 * wanted.period_cycles), mass.facts);
        EXPECT_EQ(found.mode, wanted.mode) << name(point);
        EXPECT_EQ(found.period_cycles, wanted.period_cycles) << name(point);
        modes.insert(wanted.mode);
        if (wanted.flight_number == 0) {
            EXPECT_EQ(found.flight_number, 0);
            EXPECT_FALSE(found.take_off_phase);
            EXPECT_FALSE(found.restitution);
            continue;
        }
        // Lines are a hundredth of a cycle apart; the force decreases to zero gradually and returns suddenly.
        theory::Phase const flight = longest_flight(wanted);
        EXPECT_NEAR(found.take_off_phase.value(), std::fmod(flight.start, 2 * pi), interval) << name(point);
        EXPECT_NEAR(found.flight_number, wanted.flight_number, 0.01) << name(point);
        EXPECT_NEAR(found.landing_phase.value() - found.take_off_phase.value(), flight.end - flight.start,
                    interval);
        // Plastic. Where the trough falls away faster than the mass at its landing, the mass is in the air
        // again within the interval.
        if (point.throw_number < 3.297) {
            EXPECT_NEAR(found.restitution.value(), 0, 0.01) << name(point);
        }
    }
    EXPECT_GE(clear, 120);
    for (char const* mode : {"PN", "PNR", "PR", "FP'N", "FN'", "FP'NP", "FRP", "F", "FFP'N", "R"})
        EXPECT_TRUE(modes.contains(mode)) << mode;
}

// At Gamma = 4.6 the flight lasts 1.4 cycles and the period is two cycles: a layer that skips cycles.
TEST(LayerMotion, SeesThatCyclesAreSkipped) {
    PointMassPhases mass(theory::PointMass{5.0, 0.5, 0, 0.35});
    ASSERT_EQ(mass.theory.motion.period_cycles, 2);
    LayerMotion const motion = layer_motion(mass.series(12), mass.facts);
    EXPECT_EQ(motion.period_cycles, 2);
    EXPECT_EQ(motion.curves.phase.size(), 200u);
    EXPECT_GT(motion.flight_number, 1.5);
}

// The phase of the take-off is in [0, 2 pi) wherever the cycle begins, and moves with it. At Gamma = 2.8 the
// force reaches zero before the line from which on the layer flies, so that a cycle that begins with that
// line has the take-off before its first line. Tolerance: rounding of the trace's interpolation, far smaller.
TEST(LayerMotion, TakesOffWithinATurn) {
    PointMassPhases mass(theory::PointMass{2.8, 0.5, 0, 0.23});
    PhaseSeries const series = mass.series(9);
    mass.facts.used = 8;
    double const take_off = layer_motion(series, mass.facts).take_off_phase.value();
    for (int lines = 0; lines < PhaseSeries::per_cycle; ++lines) {
        LayerMotion const motion = layer_motion(without_first(series, lines), mass.facts);
        double const found = motion.take_off_phase.value();
        EXPECT_GE(found, 0) << lines;
        EXPECT_LT(found, 2 * pi) << lines;
        EXPECT_NEAR(std::remainder(found + lines * interval - take_off, 2 * pi), 0, 1e-6) << lines;
        EXPECT_NEAR(motion.landing_phase.value() - found, 2 * pi * motion.flight_number, 1e-12) << lines;
    }
    EXPECT_EQ(within_turn(-1e-30), 0) << "2 pi, but for rounding";
}

// |F_x| / F_z = mu in every slide of a point mass; intervals in which a slide begins or ends are left out.
TEST(LayerMotion, SeesTheFrictionOfASlide) {
    for (double const mu : {0.15, 0.3, 0.45}) {
        PointMassPhases mass(theory::PointMass{0.8, 0.5, 0.02, mu});
        LayerMotion const motion = layer_motion(mass.series(6), mass.facts);
        EXPECT_NEAR(motion.friction_ratio.value(), mu, 0.01 * mu) << mass.theory.motion.mode;
    }
}

// The dissipation per cycle against the losses of the theory (friction and impacts, per unit mass in (omega
// r)^2), which are computed from an integral over the slides and not from the work of the trough. Forces are
// means over intervals in which the speed of the trough changes by up to 6 %: tolerance 1 % if there are
// impacts.
TEST(LayerMotion, DissipatesWhatTheTheorySays) {
    for (theory::PointMass const point :
         {theory::PointMass{0.8, 0.5, 0.05, 0.3}, theory::PointMass{1.5, 0.5, -0.1, 0.3},
          theory::PointMass{2.5, 0.25, 0.05, 0.5}}) {
        PointMassPhases mass(point);
        LayerMotion const motion = layer_motion(mass.series(6), mass.facts);
        auto const energy = theory::energy_balance(mass.theory);
        double const scale = PointMassPhases::mass * std::pow(mass.omega * PointMassPhases::amplitude, 2);
        double const wanted = scale * (energy.friction_loss + energy.impact_loss);
        EXPECT_NEAR(motion.dissipation.value(), wanted, 0.01 * wanted) << name(point);
    }
}

// A mass with e = 0.3 rebounds with 0.3 of its approach speed. In the rest of the interval of the impact,
// gravity and the motion of the trough reduce its relative speed: by up to a sixth of a rebound after a
// flight of a tenth of a cycle.
TEST(LayerMotion, MeasuresTheRestitution) {
    PointMassPhases mass(theory::PointMass{2.2, 0.5, 0, 0.3}, 0.3);
    LayerMotion const motion = layer_motion(mass.series(12), mass.facts);
    EXPECT_NEAR(motion.restitution.value(), 0.3, 0.05) << mass.theory.motion.mode;
}

TEST(LayerMotion, CurvesAreTheTheorysTrace) {
    PointMassPhases mass(theory::PointMass{2.0, 0.5, 0, 0.23});
    PhaseSeries const series = mass.series(7);
    PhaseCurves const curves = layer_motion(series, mass.facts).curves;
    ASSERT_EQ(curves.phase.size(), 100u);
    double const eta = mass.theory.motion.velocity_efficiency;
    EXPECT_NEAR(curves.displacement.back(), 2 * pi * eta * mass.length_x, 1e-8);
    for (std::size_t j = 0; j < 100; ++j) {
        EXPECT_NEAR(curves.phase[j], interval * static_cast<double>(j + 1), 1e-12);
        EXPECT_NEAR(curves.trough_velocity_x[j], mass.omega * mass.length_x * std::cos(curves.phase[j]),
                    1e-9);
        EXPECT_NEAR(curves.height[j], series.clearance[j], 1e-6);
        EXPECT_EQ(curves.airborne[j], series.touching[j] == 0 && series.normal_force[j] == 0 ? 1 : 0);
        if (series.touching[j] == 1) {
            EXPECT_NEAR(curves.slip[j], series.vx[j] - curves.trough_velocity_x[j], 1e-5);
        }
        // All cycles are equal, up to the linear interpolation of the trace.
        EXPECT_LT(curves.velocity_x_deviation[j], 1e-4);
    }
}

// At least one cycle and a line before the first evaluated one are required.
TEST(LayerMotion, IsEmptyWithoutCycles) {
    PointMassPhases mass(theory::PointMass{2.0, 0.5, 0, 0.23});
    PhaseSeries const series = mass.series(3);
    for (auto const& [discarded, used] : {std::pair{0, 0}, {0, 1}, {3, 3}, {2, 2}}) {
        mass.facts.discarded = discarded;
        mass.facts.used = used;
        LayerMotion const motion = layer_motion(series, mass.facts);
        EXPECT_EQ(motion.mode, "");
        EXPECT_TRUE(motion.curves.phase.empty());
        EXPECT_FALSE(motion.dissipation);
    }
    mass.facts.discarded = 0;
    mass.facts.used = 2;
    EXPECT_EQ(layer_motion(series, mass.facts).mode, mass.theory.motion.mode)
        << "the second cycle is evaluated";
}

// x = sin(t) + sin(7 t + 1) / 10: v = omega (cos(t) + 0.7 cos(7 t + 1)), exact up to rounding.
TEST(LayerMotion, PeriodicVelocityIsExactForHarmonics) {
    std::vector<double> positions;
    for (int j = 1; j <= 100; ++j)
        positions.push_back(std::sin(interval * j) + 0.1 * std::sin(7 * interval * j + 1));
    auto const velocity = periodic_velocity(positions, 3);
    for (int j = 1; j <= 100; ++j) {
        double const wanted = 6 * pi * (std::cos(interval * j) + 0.7 * std::cos(7 * interval * j + 1));
        EXPECT_NEAR(velocity[static_cast<std::size_t>(j - 1)], wanted, 1e-10);
    }
}

TEST(LayerMode, ReadsPhases) {
    std::vector<double> const force{1, 1, 1, 1, 0, 0, 0, 0, 5, 1}, level(10, 1.0);
    auto const mode = [&](std::vector<double> const& slip, std::vector<double> const& normal) {
        return mode_name(mode_phases({slip, normal, 2 * pi / 10}));
    };
    EXPECT_EQ(mode({1, 1, -1, -1, 0, 1, 2, 2, 1, 1}, force), "FP'N");
    EXPECT_EQ(mode({0, 0, 0, 0, 0, 1, 2, 2, 0, 0}, force), "FR");
    EXPECT_EQ(mode(std::vector<double>(10, 0.01), level), "R");
    EXPECT_EQ(mode(std::vector<double>(10, -1), level), "N") << "a layer that always slides down";
    EXPECT_EQ(mode(std::vector<double>(10, 1), std::vector<double>(10, 0.0)), "F");
    EXPECT_EQ(mode({-1, -1, -1, -1, 1, 1, 1, 1, -1, -1}, level), "PN") << "the first slide after phase 0";
    // One stray grain: 0.06 of the weight in a tenth of a cycle.
    EXPECT_EQ(mode({1, 1, 1, 1, 1, 1, 1, 1, 1, 1}, {5, 5, 0, 0, 0, 0.06, 0, 0, 0, 0}), "FP'");
    EXPECT_EQ(mode({1, 1, 1, 1, 1, 1, 1, 1, 1, 1}, {5, 5, 0, 0, 0, 4, 4, 0, 0, 0}), "FP'FP'");
    EXPECT_EQ(mode({1, 1, 1, -1, 1, 1, -1, -1, -1, -1}, level), "PN") << "one interval is noise";
}

}  // namespace
}  // namespace vibrotrough::measure
