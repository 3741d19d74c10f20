#include "prepare/prepared_case.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace vibrotrough::prepare {
namespace {

scenario::Scenario with_lines(std::string const& lines, scenario::FileSource const& source = {}) {
    return scenario::parse_campaign(with("throw_number = 2.0", "throw_number = 2.0\n" + lines), "c", source)
        .cases.front();
}

PointMassInputs inputs(scenario::Scenario const& s) {
    return prepare_case(s).point_mass;
}

// Both solvers on the plain drive: they agree to 1e-9 by the theory's own tests.
TEST(PointMassMotion, OfAPlainDriveIsTheFastSolvers) {
    scenario::Scenario const s = with_lines("");
    EXPECT_TRUE(inputs(s).is_plain);
    EXPECT_NEAR(solve(inputs(s)).velocity_efficiency,
                theory::solve(inputs(s).conveyor).motion.velocity_efficiency, 1e-9);
}

// The acceleration that the theory uses, -(sin t + sum a sin(k t + phase)) in units of omega^2 r
// sin(beta), is that of the drive: X'' of X = sum a_k sin(k t + phase_k).
void expect_same_acceleration(scenario::Scenario const& s) {
    theory::Conveyor const c = inputs(s).conveyor;
    scenario::DriveMotion const motion = drive_motion(s.trough);
    double shift = 0;
    for (scenario::DriveTerm const& term : motion.normal) {
        if (term.order == 1) shift = term.phase;
    }
    double const omega = angular_frequency(s.trough);
    double const normal_unit = c.point.throw_number * scenario::gravity * std::cos(s.trough.inclination);
    double const along_unit = normal_unit / c.point.tan_vibration_angle;
    for (double t = 0; t < 6.3; t += 0.37) {
        double along = 0, normal = 0;
        for (scenario::DriveTerm const& term : motion.along)
            along -=
                term.order * term.order * term.amplitude * std::sin(term.order * (t - shift) + term.phase);
        for (scenario::DriveTerm const& term : motion.normal)
            normal -=
                term.order * term.order * term.amplitude * std::sin(term.order * (t - shift) + term.phase);
        double theory_along = -c.along_ratio * std::sin(t + c.along_phase), theory_normal = -std::sin(t);
        for (theory::Harmonic const& h : c.along)
            theory_along -= h.amplitude * std::sin(h.order * t + h.phase);
        for (theory::Harmonic const& h : c.normal)
            theory_normal -= h.amplitude * std::sin(h.order * t + h.phase);
        EXPECT_NEAR(along_unit * theory_along, omega * omega * along, 1e-9 * along_unit);
        EXPECT_NEAR(normal_unit * theory_normal, omega * omega * normal, 1e-9 * normal_unit);
    }
}

TEST(PointMassMotion, SeesEllipsesHarmonicsAndWaveforms) {
    expect_same_acceleration(with_lines(""));
    expect_same_acceleration(
        with_lines("along_phase = \"20 deg\"\nharmonics = [\"5, 0.2, 30 deg\", \"25, 0.1, -9 deg\"]"));
    std::string csv = "time_s,x_m,z_m\n";
    scenario::Scenario const plain = with_lines("");
    for (int i = 0; i < 32; ++i) {
        double const t = 2 * std::numbers::pi * i / 32;
        csv += fmt::format("{},{},{}\n", i / 32.0 / plain.trough.frequency,
                           6e-3 * std::cos(std::numbers::pi / 6) * std::sin(t + 0.7) + 1e-4 * std::sin(3 * t),
                           3e-3 * std::sin(t + 0.4) + 2e-4 * std::sin(2 * t - 1));
    }
    expect_same_acceleration(with_lines("waveform = \"m.csv\"", {{}, {{"m.csv", csv}}}));
}

// Janssen's ratio: two walls add k mu_w H / W to mu (theory/conveyor.hpp).
TEST(PointMassMotion, SeesSideWalls) {
    scenario::Scenario const s = with_lines("side_wall_friction = 0.3");
    double const expected = 0.23 + 0.5 * 0.3 * 12.0 / 18.0;
    EXPECT_NEAR(theory::effective_friction(inputs(s).conveyor).kinetic_friction, expected, 1e-12);
    EXPECT_NE(solve(inputs(s)).velocity_efficiency, solve(inputs(with_lines(""))).velocity_efficiency);
    // A measured friction includes the walls' effect: the walls are left out.
    EXPECT_EQ(solve(with_friction(inputs(s), 0.23)).velocity_efficiency,
              solve(inputs(with_lines(""))).velocity_efficiency);
}

// What a user noticed of a level trough with tan(beta) = 0.5 and mu = 0.3, for throw numbers of 1.5, 2 and 3:
// plastic 0.367, 0.621, 0.993; with e = 0.2 0.367, 0.563, 0.862 (three digits, so that rounding is 0.0005);
// with e = 0.8 0.459, 0.461, 0.480, means of motions without a period, which their own intervals hold.
TEST(PointMassMotion, WithRestitutionIsNotPlastic) {
    constexpr std::array throw_numbers{1.5, 2.0, 3.0};
    constexpr std::array plastic{0.367, 0.621, 0.993}, little{0.367, 0.563, 0.862}, much{0.459, 0.461, 0.480};
    for (std::size_t i = 0; i < throw_numbers.size(); ++i) {
        PointMassInputs point{.conveyor = {}, .start_phase = 0, .is_plain = true, .restitution = 0.2};
        point.conveyor.point = {.throw_number = throw_numbers[i],
                                .tan_vibration_angle = 0.5,
                                .tan_inclination = 0,
                                .friction = 0.3};
        PointMassTheory const low = point_mass_theory(point);
        EXPECT_NEAR(low.efficiency.value(), plastic[i], 0.0005);
        EXPECT_NEAR(low.efficiency_restitution.value(), little[i], 0.0005);
        EXPECT_FALSE(low.half_width_restitution) << "a motion with a period is known exactly";
        EXPECT_FALSE(low.mode_restitution.empty());
        point.restitution = 0.8;
        PointMassTheory const high = point_mass_theory(point);
        EXPECT_EQ(high.efficiency, low.efficiency) << "the paper's mass is plastic whatever the restitution";
        EXPECT_EQ(high.mode, low.mode);
        EXPECT_NEAR(high.efficiency_restitution.value(), much[i], high.half_width_restitution.value());
        EXPECT_TRUE(high.mode_restitution.empty()) << "without a period there is no mode";
    }
}

TEST(PointMassMotion, HasTheRestitutionOfTheCase) {
    scenario::Scenario s = with_lines("");
    s.trough.restitution = 0.37;
    EXPECT_EQ(inputs(s).restitution, 0.37);
    EXPECT_EQ(inputs(s).conveyor.restitution, 0) << "what the paper's theory takes";
    s.trough.restitution = 1;  // the theory refuses more than 0.95
    PointMassTheory const elastic = point_mass_theory(inputs(s));
    EXPECT_TRUE(elastic.efficiency);
    EXPECT_FALSE(elastic.efficiency_restitution || elastic.half_width_restitution);
    EXPECT_TRUE(elastic.mode_restitution.empty());
}

}  // namespace
}  // namespace vibrotrough::prepare
