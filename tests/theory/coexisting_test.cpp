#include "theory/coexisting.hpp"

#include "bouncing_mass.hpp"
#include "theory/batch.hpp"

#include <algorithm>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace vibrotrough::theory {
namespace {

class RandomStarts {
  public:
    double between(double low, double high) { return std::uniform_real_distribution<>(low, high)(random_); }
    Conveyor conveyor(double restitution) {
        Conveyor c{};
        double const mu = between(0.05, 0.85);
        c.point = {std::exp(between(std::log(0.5), std::log(5.0))),
                   std::tan(between(10, 60) * std::numbers::pi / 180), between(-0.9, 0.9) * mu, mu};
        c.restitution = restitution;
        return c;
    }
    /// A start within the same limits as those of the survey: a rebound below 2 e / (1 - e), any phase, and a
    /// slip up to 2.
    void start(BouncingMass<double>& mass, double restitution) {
        mass.t = between(0, 2 * std::numbers::pi);
        mass.rate = between(0, 1) * 2 * restitution / (1 - restitution);
        mass.v = between(-2, 2);
    }

  private:
    std::mt19937_64 random_{28};
};

std::vector<CoexistingMotion> survey(Conveyor const& c) {
    return MotionSurvey()(c, EfficiencySolver().solve(c));
}

bool all_periodic(std::vector<CoexistingMotion> const& all) {
    return std::ranges::all_of(all, [](auto const& one) { return one.motion.outcome == Outcome::periodic; });
}

// The mean over 500 cycles that end with a landing or a take-off: a part of a period and of a flight of up to
// some cycles are too many or too few.
constexpr double of_a_mean = 0.01;

/// The motion of this efficiency; nothing if there is none.
std::optional<std::size_t> motion_of(std::vector<CoexistingMotion> const& all, double eta) {
    for (std::size_t i = 0; i < all.size(); ++i) {
        double const expected = all[i].motion.velocity_efficiency;
        if (std::abs(eta - expected) < of_a_mean * (1 + std::abs(expected))) return i;
    }
    return {};
}

/// Whether a mean tells the motions apart.
bool apart(std::vector<CoexistingMotion> const& all) {
    for (std::size_t i = 0; i < all.size(); ++i) {
        double const eta = all[i].motion.velocity_efficiency;
        for (std::size_t k = 0; k < i; ++k) {
            if (std::abs(eta - all[k].motion.velocity_efficiency) < 3 * of_a_mean * (1 + std::abs(eta)))
                return false;
        }
    }
    return true;
}

// Another simulator is started at random. (1) Its motions are those that the survey found: one that more than
// 10 % of its starts lead to is missed by the 64 starts of the survey with a probability of 0.001, and one
// of 5 % of 0.04: in nearly no conveyor do more than a tenth of these starts lead elsewhere. (2) As many
// lead to each as the survey says: z = (n - N share) / s, with s^2 = N share (1 - share) (1 + N / 64) because
// both numbers are counted, has a mean square of 1, with a standard deviation of sqrt(2 / n) for n conveyors:
// 0.35 for the some 16 here. Within two of these it is 0.3 to 1.7. (3) Each is an attractor: after a change
// of 1e-6 the mass returns to it.
TEST(CoexistingMotions, AreThoseOfAnotherSimulator) {
    RandomStarts random;
    constexpr int starts = 40;
    int conveyors = 0, several = 0, missed = 0, compared = 0, counted = 0, returned = 0;
    double squares = 0;
    while (conveyors < 120) {
        double const e = random.between(0.1, 0.7);
        Conveyor const c = random.conveyor(e);
        auto const found = survey(c);
        if (!all_periodic(found) || !apart(found)) continue;
        ++conveyors;
        several += found.size() > 1 ? 1 : 0;
        std::vector<int> count(found.size());
        int others = 0;
        for (int i = 0; i < starts; ++i) {
            BouncingMass<double> mass(c, 1e-13);
            random.start(mass, e);
            mass.follow(400);
            auto const which = motion_of(found, mass.follow(500));
            if (!which) {
                ++others;
                continue;
            }
            if (++count[*which] > 1 || found.size() == 1) continue;
            mass.v += 1e-6;
            mass.rate *= 1 + 1e-6;
            mass.follow(100);
            ++counted;
            returned += motion_of(found, mass.follow(500)) == which ? 1 : 0;
        }
        missed += others > starts / 10 ? 1 : 0;
        if (others > 0) continue;
        if (found.size() == 1) continue;
        ++compared;
        double const share = std::clamp(found[0].share, 1.0 / usual_starts, 1 - 1.0 / usual_starts);
        double const off = count[0] - starts * share;
        squares += off * off / (starts * share * (1 - share) * (1 + starts / double(usual_starts)));
    }
    EXPECT_LT(squares / compared, 1.7);
    EXPECT_GT(squares / compared, 0.3);
    EXPECT_GT(compared, 12);
    EXPECT_GT(several, 15);
    EXPECT_LE(missed, 3);
    EXPECT_EQ(returned, counted);
}

// A mass that rebounds can keep bouncing on a trough from which a mass at rest never takes off. It lands once
// a cycle at a time t0 with cos(t0) = pi (1 - e) / ((1 + e) Gamma), so that Gamma may be as low as pi (1 - e)
// / (1 + e): 0.554 for e = 0.7. At rest it slides or rests.
TEST(CoexistingMotions, BounceBesideRestBelowTakeOff) {
    Conveyor c{};
    c.point = {0.8, 0.5, -0.05, 0.3};
    c.restitution = 0.7;
    auto const found = survey(c);
    ASSERT_GE(found.size(), 2u);
    EXPECT_EQ(to_string(found[0].motion.mode).find('F'), std::string::npos);
    EXPECT_TRUE(std::ranges::any_of(found, [](auto const& one) {
        return to_string(one.motion.mode) == "F" && one.motion.period_cycles == 1;
    }));
    c.point.throw_number = 0.5;
    EXPECT_EQ(survey(c).size(), 1u);
}

// The first motion is that of the standard start, to the last bit, and the fractions add up to 1.
TEST(CoexistingMotions, BeginWithThatOfTheStandardStart) {
    RandomStarts random;
    for (int i = 0; i < 300; ++i) {
        Conveyor const c = random.conveyor(random.between(0, 0.8));
        Efficiency const standard = EfficiencySolver().solve(c);
        auto const found = MotionSurvey()(c, standard, 16);
        EXPECT_EQ(found[0].motion.velocity_efficiency, standard.velocity_efficiency);
        EXPECT_EQ(found[0].motion.mode, standard.mode);
        double all = 0;
        for (auto const& one : found) all += one.share;
        EXPECT_NEAR(all, 1, 1e-12) << "rounding of a sum";
    }
}

// Without rebounds, as in compare and design, friction and landings make the mass forget its start: one
// motion, also with harmonics and a larger static friction.
TEST(CoexistingMotions, AreOneWithoutRebounds) {
    RandomStarts random;
    for (int i = 0; i < 500; ++i) {
        Conveyor c = random.conveyor(0);
        if (i % 2 == 0) c.static_friction = c.point.friction * random.between(1, 2);
        if (i % 3 == 0) c.normal = {{2, random.between(-0.6, 0.6), random.between(-3, 3)}};
        if (i % 5 == 0) c.along = {{3, random.between(-0.6, 0.6), random.between(-3, 3)}};
        EXPECT_EQ(survey(c).size(), 1u) << i;
    }
}

// Nothing of other points is remembered: a batch and a map say the same as one point alone.
TEST(CoexistingMotions, AreTheSameInBatchAndMap) {
    Inputs in;
    in.set(Input::tan_vibration_angle, 0.5);
    in.set(Input::tan_inclination, -0.1);
    in.set(Input::restitution, 0.4);
    MapAxis const x{Input::throw_number, 0.8, 4, 9}, y{Input::friction, 0.2, 0.4, 3};
    Map const map = solve_map(in, x, y, {.starts = 16, .boundaries = false});
    std::vector<Inputs> points;
    for (int j = 0; j < y.count; ++j) {
        for (int i = 0; i < x.count; ++i) {
            in.set(Input::throw_number, x.value(i));
            in.set(Input::friction, y.value(j));
            points.push_back(in);
        }
    }
    BatchResult const batch = solve_batch(points, 2, {}, 1, 16);
    int several = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        Conveyor const c = points[i].conveyor();
        auto const alone = MotionSurvey()(c, EfficiencySolver().solve(c), 16);
        several += alone.size() > 1 ? 1 : 0;
        for (auto const* const other : {&batch.motions[i], &map.motions[i]}) {
            ASSERT_EQ(other->size(), alone.size());
            for (std::size_t k = 0; k < alone.size(); ++k) {
                EXPECT_EQ((*other)[k].motion.velocity_efficiency, alone[k].motion.velocity_efficiency);
                EXPECT_EQ((*other)[k].share, alone[k].share);
            }
        }
    }
    EXPECT_GT(several, 0);
    EXPECT_TRUE(solve_batch(points, 1).motions.empty());
    EXPECT_THROW(solve_batch(points, 1, RollingLaw{}, 1, 16), std::invalid_argument);
}

}  // namespace
}  // namespace vibrotrough::theory
