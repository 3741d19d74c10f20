#include "theory/batch.hpp"
#include "theory/conveyor.hpp"
#include "theory/map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

// All commands solve a motion by the same means, and none remembers anything that changes a bit.

namespace vibrotrough::theory {
namespace {

/// Inputs of all kinds, one after another: the plastic point mass, and every extension that a batch knows,
/// alone and combined. The throw number stays the same for some of them, as on a line of a map.
class RandomInputs {
  public:
    Inputs next() {
        Inputs in;
        double const mu = between(0.05, 0.85);
        if (chance(0.3)) throw_number_ = std::exp(between(std::log(0.2), std::log(8.0)));
        in.set(Input::throw_number, throw_number_);
        in.set(Input::vibration_angle_deg, between(2, 82));
        in.set(Input::tan_inclination, between(-0.99, 0.99) * mu);
        in.set(Input::friction, mu);
        double const share = chance(0.2) ? 0 : 0.3;
        if (chance(share)) in.set(Input::static_friction, mu * between(1, 2));
        if (chance(share)) in.set(Input::restitution, between(0, 0.8) * between(0, 1));
        if (chance(share)) in.set(Input::landing_friction, mu * between(0, 2));
        if (chance(share)) in.set(Input::air_drag, std::pow(10, between(-3, 0.5)));
        if (chance(share)) in.set(Input::along_ratio, between(-2, 2));
        if (chance(share)) in.set(Input::along_phase_deg, between(-180, 180));
        if (chance(share))
            in.set(Input::wall_friction, between(0, 1)), in.set(Input::height_over_width, between(0, 1));
        return in;
    }

  private:
    double between(double low, double high) { return std::uniform_real_distribution<>(low, high)(random_); }
    bool chance(double share) { return between(0, 1) < share; }

    std::mt19937_64 random_{20261125};
    double throw_number_ = 1.5;
};

/// Whether two numbers are the same, or both are none.
bool same(double a, double b) {
    return a == b || (std::isnan(a) && std::isnan(b));
}

void expect_same(Efficiency const& found, Efficiency const& expected, int i) {
    EXPECT_TRUE(same(found.velocity_efficiency, expected.velocity_efficiency))
        << i << ' ' << found.velocity_efficiency << ' ' << expected.velocity_efficiency;
    EXPECT_EQ(found.half_width, expected.half_width) << i;
    EXPECT_EQ(to_string(found.mode), to_string(expected.mode)) << i;
    EXPECT_EQ(found.period_cycles, expected.period_cycles) << i;
    EXPECT_EQ(found.outcome, expected.outcome) << i;
}

/// The beginning of a mode in which flights that follow each other are one.
std::string with_chains_joined(ModeCode code) {
    std::string text = to_string(code);
    auto const both_fly = [](char a, char b) { return a == 'F' && b == 'F'; };
    text.erase(std::unique(text.begin(), text.end(), both_fly), text.end());
    return text;
}

// A plastic mass whose flights do not repeat has a mean with an interval, in a batch as alone.
TEST(OneAnswer, OfPlasticMotionsWithoutAPeriod) {
    Inputs in;
    in.set(Input::throw_number, 3.72419);
    in.set(Input::tan_vibration_angle, 10);
    in.set(Input::friction, 0.23);
    ConveyorMotion const alone = solve(in.conveyor());
    ASSERT_GT(alone.half_width, 0);
    EXPECT_EQ(solve_batch({in}, 1).points.front().half_width, alone.half_width);
}

// A motion whose phases cannot be solved costs a batch one row, not all.
TEST(OneAnswer, OfAnUnsolvableRowIsUnsettled) {
    Inputs in, hard;
    in.set(Input::throw_number, 2);
    in.set(Input::tan_vibration_angle, 0.5);
    in.set(Input::friction, 0.3);
    hard.set(Input::throw_number, 3.2969083095);
    hard.set(Input::tan_vibration_angle, 10);
    hard.set(Input::tan_inclination, 0.1);
    hard.set(Input::friction, 0.1);
    hard.set(Input::static_friction, 0.1000000000000001);
    BatchResult const batch = solve_batch({in, hard, in}, 1);
    EXPECT_EQ(batch.points[2].velocity_efficiency, batch.points[0].velocity_efficiency);
    bool const is_solved = std::isfinite(batch.points[1].velocity_efficiency);
    EXPECT_TRUE(is_solved || batch.points[1].outcome == Outcome::unsettled);
}

// `theory point` and `theory batch` of 10,000 motions give the same to the last bit.
TEST(OneAnswer, OfPointAndBatch) {
    RandomInputs random;
    std::vector<Inputs> inputs;
    for (int i = 0; i < 10000; ++i) inputs.push_back(random.next());
    BatchResult const batch = solve_batch(inputs, 0);
    for (int i = 0; i < 10000; ++i) {
        ConveyorMotion const alone = solve(inputs[static_cast<std::size_t>(i)].conveyor());
        expect_same(batch.points[static_cast<std::size_t>(i)], efficiency_of(alone), i);
    }
}

// The same for the points of a map, in which the throw number stays the same for many points. There a chain
// of rebounds counts as one flight.
TEST(OneAnswer, OfMapAndBatch) {
    RandomInputs random;
    for (int k = 0; k < 40; ++k) {
        Inputs fixed = random.next(), at = fixed;
        for (Input const axis : {Input::throw_number, Input::friction}) fixed.clear(axis);
        double const slope = std::abs(*fixed.get(Input::tan_inclination));
        double const most = std::min(1.0, fixed.get(Input::static_friction).value_or(1.0));
        if (slope > 0.9 * most) continue;
        Map const map = solve_map(fixed, {Input::throw_number, 0.5, 4.5, 16},
                                  {Input::friction, slope, most, 16}, {.boundaries = false});
        std::vector<Inputs> inputs;
        for (int j = 0; j < 16; ++j) {
            for (int i = 0; i < 16; ++i) {
                at.set(Input::throw_number, map.x.value(i));
                at.set(Input::friction, map.y.value(j));
                inputs.push_back(at);
            }
        }
        BatchResult const batch = solve_batch(inputs, 0);
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            Efficiency expected = batch.points[i];
            if (fixed.get(Input::restitution)) {
                EXPECT_EQ(to_string(map.points[i].mode), with_chains_joined(expected.mode)) << i;
                expected.mode = map.points[i].mode;
            }
            expect_same(map.points[i], expected, static_cast<int>(i));
        }
    }
}

// Without rebounds a map names every flight, also when a restitution of 0 is written down.
TEST(OneAnswer, DoesNotDependOnARestitutionOfZero) {
    Inputs in;
    in.set(Input::tan_vibration_angle, 0.5);
    in.set(Input::tan_inclination, -0.1);
    MapAxis const x{Input::throw_number, 3.5, 5.5, 21}, y{Input::friction, 0.2, 0.4, 3};
    Map const plain = solve_map(in, x, y, {.boundaries = false});
    in.set(Input::restitution, 0);
    Map const same_motion = solve_map(in, x, y, {.boundaries = false});
    for (std::size_t i = 0; i < plain.points.size(); ++i)
        EXPECT_EQ(to_string(plain.points[i].mode), to_string(same_motion.points[i].mode)) << i;
    EXPECT_TRUE(std::ranges::any_of(
        plain.points, [](Efficiency const& p) { return to_string(p.mode).substr(0, 2) == "FF"; }));
}

// From rest and from ten random starts, with noise of 1e-12, this motion ends at -0.0473 within 3000 cycles;
// a walk without noise follows its own rounding and has no period.
TEST(OneAnswer, IsWhatAMachineDoes) {
    Conveyor c{};
    c.point = {2.858540, 0.896760, 0.122648, 0.139461};
    c.restitution = 0.239105;
    ConveyorMotion const answer = solve(c);
    EXPECT_NEAR(answer.motion.velocity_efficiency, -0.0473, 5e-5);
    EXPECT_EQ(answer.motion.period_cycles, 3);
    EXPECT_EQ(answer.motion.velocity_efficiency, EfficiencySolver().solve(c).velocity_efficiency);
}

// The phases, forces and energies of a motion are those of its efficiency: the pieces follow each other
// without a gap and add up to it. Tolerance: rounding; Newton's last step; a period is accepted when its
// state repeats to 1e-11, and rebounds below slowest_rebound = 1e-6 end a chain.
TEST(OneAnswer, OfEfficiencyAndPhases) {
    RandomInputs random;
    int periodic = 0;
    for (int i = 0; i < 2000; ++i) {
        Conveyor const c = random.next().conveyor();
        ConveyorMotion const answer = solve(c);
        Motion const& m = answer.motion;
        if (answer.pieces.empty()) continue;
        double moved = 0, gap = 0;
        for (std::size_t k = 0; k < answer.pieces.size(); ++k) {
            moved += answer.pieces[k].displacement;
            if (k > 0) gap = std::max(gap, std::abs(answer.pieces[k].start - answer.pieces[k - 1].end));
        }
        double const length = answer.pieces.back().end - answer.pieces.front().start;
        EXPECT_LT(gap, 1e-9) << i << ' ' << m.mode;
        if (!m.converged) {
            EXPECT_NEAR(length, 2 * std::numbers::pi * answer.cycles_followed, 0.02 * length) << i;
            EXPECT_NEAR(moved / length, m.velocity_efficiency, answer.half_width) << i;
            continue;
        }
        ++periodic;
        EXPECT_NEAR(moved / length, m.velocity_efficiency, 1e-9 * (1 + std::abs(m.velocity_efficiency))) << i;
        EXPECT_NEAR(length, 2 * std::numbers::pi * m.period_cycles, 1e-6) << i << ' ' << m.mode;
    }
    EXPECT_GT(periodic, 1000);
}

}  // namespace
}  // namespace vibrotrough::theory
