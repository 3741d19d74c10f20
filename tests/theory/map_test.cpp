#include "theory/map.hpp"

#include "theory/limits.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace vibrotrough::theory {
namespace {

Inputs paper_inputs() {
    Inputs inputs;
    inputs.set(Input::friction, 0.35);
    inputs.set(Input::tan_inclination, -0.1);
    return inputs;
}

// Every point of a map equals the point solved alone, for any number of threads. Tolerance: both know eta to
// 1e-9.
TEST(Map, IsItsPoints) {
    MapAxis const x{Input::throw_number, 0.3, 3.3, 41}, y{Input::vibration_angle_deg, 5, 60, 31};
    for (int const jobs : {1, 2}) {
        Map const map = solve_map(paper_inputs(), x, y, {.jobs = jobs, .boundaries = false});
        for (int j = 0; j < 31; j += 3) {
            for (int i = 0; i < 41; i += 3) {
                double const tan_beta = std::tan(y.value(j) * std::acos(-1.0) / 180);
                Motion const motion = solve(PointMass{x.value(i), tan_beta, -0.1, 0.35});
                Efficiency const& point = map.points[static_cast<std::size_t>(j * 41 + i)];
                EXPECT_NEAR(point.velocity_efficiency, motion.velocity_efficiency, 2e-9);
                EXPECT_EQ(to_string(point.mode), motion.mode);
            }
        }
        EXPECT_GT(map.cpu_seconds_per_solution, 0);
    }
}

// The boundary between modes with and without flight is exactly Gamma = 1; there is none between FP'... and
// longer flights. Tolerance: 2^-30 of a cell of 0.1.
TEST(Map, BoundariesAreRoots) {
    MapAxis const x{Input::throw_number, 0.35, 1.55, 13}, y{Input::vibration_angle_deg, 20, 50, 13};
    Map const map = solve_map(paper_inputs(), x, y, {});
    int at_one = 0;
    for (BoundaryPiece const& piece : map.boundaries) {
        bool const flies_a = to_string(piece.mode_a)[0] == 'F', flies_b = to_string(piece.mode_b)[0] == 'F';
        if (flies_a == flies_b || std::abs(piece.y0 - piece.y1) < 1e-3) continue;
        bool const whole_edge = std::abs(std::abs(piece.y1 - piece.y0) - 2.5) < 1e-9;
        if (!whole_edge) continue;
        ++at_one;
        EXPECT_NEAR(piece.x0, 1, 1e-9);
        EXPECT_NEAR(piece.x1, 1, 1e-9);
    }
    EXPECT_GT(at_one, 3);
}

// Fig. 7: at beta = 0 the boundary between PRNR and PN is at K = mu sqrt(1 + pi^2/4).
TEST(Map, ModeDiagramAtSmallVibrationAngles) {
    Inputs inputs;
    inputs.set(Input::friction, 0.35);
    MapAxis const x{Input::machine_number, 0.5, 1.5, 11}, y{Input::vibration_angle_deg, 0, 2, 3};
    Map const map = solve_map(inputs, x, y, {});
    bool found = false;
    for (BoundaryPiece const& piece : map.boundaries) {
        if (piece.y0 != 0) continue;
        if (to_string(piece.mode_a) == "PRNR" && to_string(piece.mode_b) == "PN") {
            EXPECT_NEAR(piece.x0, pn_machine_number(0.35), 1e-6);
            found = true;
        }
    }
    EXPECT_TRUE(found);
}

TEST(Map, TakesAnyTwoInputs) {
    Inputs inputs;
    inputs.set(Input::throw_number, 2);
    inputs.set(Input::tan_vibration_angle, 0.25);
    inputs.set(Input::friction, 0.23);
    MapAxis const x{Input::restitution, 0, 0.2, 3}, y{Input::tan_inclination, -0.05, 0.05, 3};
    Map const map = solve_map(inputs, x, y, {});
    EXPECT_NEAR(map.points[0].velocity_efficiency, 0.537, 0.001);  // Table 1, e = 0
    EXPECT_NEAR(map.points[8].velocity_efficiency, 0.4755, 0.001);
}

// While the lines are located, all points are there; what is done with them may fail.
TEST(Map, PointsCanBeUsedBeforeTheLinesAreFound) {
    MapAxis const x{Input::throw_number, 0.3, 3.3, 41}, y{Input::vibration_angle_deg, 5, 60, 31};
    auto const etas = [](Map const& map) {
        std::vector<double> all;
        for (Efficiency const& point : map.points) all.push_back(point.velocity_efficiency);
        return all;
    };
    Map const whole = solve_map(paper_inputs(), x, y, {.jobs = 1});
    EXPECT_GT(whole.boundaries.size(), 10u);
    for (int const jobs : {1, 2}) {
        std::vector<std::vector<double>> seen;
        Map const map = solve_map(paper_inputs(), x, y, {.jobs = jobs, .with_points = [&](Map const& points) {
                                                             seen.push_back(etas(points));
                                                         }});
        ASSERT_EQ(seen.size(), 1u);
        EXPECT_EQ(seen.front(), etas(map));
        EXPECT_EQ(map.boundaries.size(), whole.boundaries.size());
        MapOptions const failing{.jobs = jobs,
                                 .with_points = [](Map const&) { throw std::runtime_error("full"); }};
        EXPECT_THROW(solve_map(paper_inputs(), x, y, failing), std::runtime_error);
    }
}

TEST(Map, RefusesInputsThatDoNotFit) {
    MapAxis const x{Input::throw_number, 0.3, 3.3, 3}, y{Input::vibration_angle_deg, 5, 60, 3};
    EXPECT_THROW(solve_map(Inputs{}, x, y, {}), std::invalid_argument);        // friction is missing
    EXPECT_THROW(solve_map(paper_inputs(), x, x, {}), std::invalid_argument);  // the same axis twice
    Inputs twice = paper_inputs();
    twice.set(Input::throw_number, 2);
    EXPECT_THROW(solve_map(twice, x, y, {}), std::invalid_argument);
    MapAxis const bad{Input::friction, -1, 1, 3};
    EXPECT_THROW(solve_map(paper_inputs(), x, bad, {}), std::invalid_argument);
}

}  // namespace
}  // namespace vibrotrough::theory
