#include "learn/risk_design.hpp"

#include "core/error.hpp"
#include "learn/design_report.hpp"
#include "learn/pellets.hpp"
#include "learn/rules_of_thumb.hpp"
#include "theory/point_mass.hpp"
#include "theory/quantities.hpp"
#include "theory/random_number.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include <boost/math/special_functions/erf.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <rapidcheck/gtest.h>

namespace vibrotrough::learn {
namespace {

using theory::between;
constexpr double pi = std::numbers::pi;

theory::PointMass point_of(theory::Drive const& d, double friction) {
    return {d.throw_number(), std::tan(d.vibration_angle), std::tan(d.inclination), friction};
}

/// 4000 tries of friction and theory: how often the machine of a design carries the mass flow.
double tried_probability(DesignTask const& task, double sd, RiskDesign const& d) {
    int reached = 0;
    constexpr int tries = 4000;
    for (int i = 0; i < tries; ++i) {
        // Two quasi-random normal numbers by Box and Muller from the golden ratio's sequence.
        double const u = (i + 0.5) / tries, w = std::fmod(i * 0.6180339887498949, 1.0);
        double const r = std::sqrt(-2 * std::log(u));
        double const mu = std::max(0.01, task.friction.median + sd * r * std::cos(2 * pi * w));
        double const eta = theory::solve(point_of(d.drive, mu)).velocity_efficiency +
                           task.models.front().missed(d.drive, {}) * r * std::sin(2 * pi * w);
        double const flow = task.bulk_density * task.width * d.depth * eta * d.drive.trough_speed();
        reached += flow >= task.mass_flow ? 1 : 0;
    }
    return static_cast<double>(reached) / tries;
}

// The probability that is printed is that of trying: nine values of the friction know it to about 0.01. The
// depth is rounded up to 0.1 mm, which here raises it by up to 0.01 more.
TEST(RiskDesign, ProbabilityIsThatOfTrying) {
    DesignTask task = pellets();
    RiskDesign const d = design_with_risk(task);
    ASSERT_TRUE(d.feasible);
    EXPECT_GE(d.probability, 0.95);
    EXPECT_LT(d.probability, 0.97);
    EXPECT_NEAR(tried_probability(task, 0.03, d), d.probability, 0.012);
    ModelForecast const& f = d.forecasts.front();
    EXPECT_LT(f.low_flow, task.mass_flow);
    EXPECT_GT(f.median_flow, task.mass_flow);
    EXPECT_GT(f.high_flow, f.median_flow);
}

/// What a user may ask for.
DesignTask any_task() {
    DesignTask task = pellets();
    task.space.max_machine_number = between(1, 6);
    task.space.max_throw_number = between(0.8, 3.29);
    task.space.frequency = {between(5, 8), between(15, 50)};
    task.space.amplitude = {between(0.0005, 0.001), between(0.003, 0.015)};
    task.space.inclination = {between(-0.05, 0), between(0, 0.05)};
    task.friction = normal_friction(between(0.25, 0.6), between(0, 0.05));
    task.mass_flow = between(1, 40) / 3.6;
    if (*rc::gen::arbitrary<bool>()) task.landing_speed = between(0.05, 0.6);
    task.objective = *rc::gen::element(Objective::fastest, Objective::gentlest_landing,
                                       Objective::least_machine_number, Objective::least_power);
    return task;
}

// No printed design breaks a printed limit, whatever the friction within its central 99.7 %. The landing
// speed is that of the general solver, which shares no code with the closed form by which the design is
// searched for; the tolerance of 1e-5 is that of this comparison (1e-6 of omega r) and of the search for the
// worst friction (Brent's method stops at a relative 2^-12 in the friction, where the speed is flat).
RC_GTEST_PROP(RiskDesign, BreaksNoLimitAtAnyFriction, ()) {
    DesignTask const task = any_task();
    RiskDesign const d = design_with_risk(task);
    theory::Drive const& m = d.drive;
    auto const within = [](double value, theory::Range const& r) {
        return value >= r.low && value <= r.high;
    };
    RC_ASSERT(within(m.frequency, task.space.frequency) && within(m.amplitude, task.space.amplitude));
    RC_ASSERT(within(m.vibration_angle, task.space.vibration_angle));
    RC_ASSERT(within(m.inclination, task.space.inclination));
    RC_ASSERT(within(d.depth, task.depth));
    RC_ASSERT(m.machine_number(9.81) <= task.space.max_machine_number);
    RC_ASSERT(m.throw_number() <= task.space.max_throw_number);
    if (task.landing_speed) RC_ASSERT(d.landing_speed <= *task.landing_speed);
    if (d.feasible) RC_ASSERT(d.probability >= task.confidence - 1e-6);
    for (int i = 0; i < 5; ++i) {
        double const mu = between(task.friction.low, task.friction.high);
        RC_ASSERT(std::abs(std::tan(m.inclination)) < mu);  // it never runs away
        if (m.throw_number() <= 1) continue;
        theory::Conveyor conveyor{};
        conveyor.point = point_of(m, mu);
        auto const motion = theory::solve(conveyor);
        RC_PRE(motion.motion.converged);
        double const speed = theory::engineer_quantities(motion, {m.amplitude}).impact_speed;
        RC_ASSERT(speed <= d.landing_speed * (1 + 1e-5));
    }
}

/// How often the machine of a design carries the mass flow by a model, from random frictions of a normal
/// distribution, each of another one of its equal parts. What the model misses is taken into account exactly.
double tried_probability(DesignTask const& task, double median, double sd, RiskDesign const& d,
                         DesignModel const& model, int tries) {
    double const needed = task.mass_flow / (task.bulk_density * task.width * d.depth);
    double sum = 0;
    for (int i = 0; i < tries; ++i) {
        double const share = std::clamp((i + between(0, 1)) / tries, 1e-9, 1 - 1e-9);
        double const mu = std::max(0.01, median - sd * std::sqrt(2.0) * boost::math::erfc_inv(2 * share));
        auto const value = model.at({d.drive, d.depth}, mu);
        if (!value) continue;
        double const missed = std::hypot(value->sd(), *model.discrepancy) * d.drive.trough_speed();
        double const excess = value->efficiency * d.drive.trough_speed() - needed * (1 - 1e-9);
        sum += missed > 0 ? 0.5 * std::erfc(-excess / (missed * std::sqrt(2.0))) : (excess >= 0 ? 1 : 0);
    }
    return sum / tries;
}

// The probability that is printed is the distribution's, within half a point, also with a model without an
// error of its own, whose speed is not smooth in the friction; and it is at least the confidence that was
// asked. Random errors of trying: below 0.1 point, as each friction is drawn from its own part of 20,000.
RC_GTEST_PROP(RiskDesign, ProbabilityIsTheDistributions, ()) {
    DesignTask task = any_task();
    double const median = between(0.2, 0.6), sd = between(0.005, 0.05);
    task.friction = normal_friction(median, sd);
    task.models = {point_mass_design_model(*rc::gen::element(0.0, 0.002, 0.01))};
    task.confidence = *rc::gen::element(0.5, 0.8, 0.95, 0.99, 0.999);
    task.depth.high = 0.1;
    RiskDesign const d = design_with_risk(task);
    double const tried = tried_probability(task, median, sd, d, task.models.front(), 20000);
    RC_ASSERT(std::abs(tried - d.probability) <= 0.005);
    if (d.feasible) RC_ASSERT(tried >= task.confidence - std::min(0.005, (1 - task.confidence) / 2));
    // The depth is that of the sure speed, rounded up to 0.1 mm.
    if (!d.feasible || d.depth <= task.depth.low) return;
    double const depth = task.mass_flow / (task.bulk_density * task.width * d.sure_speed);
    RC_ASSERT(d.depth >= depth * (1 - 1e-9) && d.depth <= depth + 1.001e-4);
}

// The tails count: nine frictions once stood for the distribution, and 100.0 % was printed for a machine that
// 97.0 % of the frictions reach. Half a point as above.
TEST(RiskDesign, KnowsTheTailsOfTheFriction) {
    DesignTask task = pellets();
    task.depth = {0.005, 0.06};
    task.models = {point_mass_design_model(0)};
    task.confidence = 0.99;
    RiskDesign const d = design_with_risk(task);
    EXPECT_NEAR(tried_probability(task, 0.03, d), d.probability, 0.005);
    EXPECT_TRUE(!d.feasible || d.probability >= 0.99) << d.probability;
}

// The numbers are those that a workshop sets: what is printed is what was judged.
TEST(RiskDesign, IsRoundedToWhatAWorkshopSets) {
    RiskDesign const d = design_with_risk(pellets());
    auto const is_whole = [](double value) { return std::abs(value - std::round(value)) < 1e-6; };
    EXPECT_TRUE(is_whole(60 * d.drive.frequency * 10)) << 60 * d.drive.frequency;
    EXPECT_TRUE(is_whole(2e3 * d.drive.amplitude * 100)) << 2e3 * d.drive.amplitude;
    EXPECT_TRUE(is_whole(d.drive.vibration_angle * 180 / pi * 20)) << d.drive.vibration_angle * 180 / pi;
}

/// m/s, of the fastest level drive on a grid of a space.
double fastest_on_a_grid(theory::DriveSpace const& s, double friction) {
    double fastest = 0;
    for (int i = 0; i <= 60; ++i) {
        double const amplitude = s.amplitude.low * std::pow(s.amplitude.high / s.amplitude.low, i / 60.0);
        for (int j = 0; j <= 120; ++j) {
            double const share = j / 120.0;
            double const beta = (1 - share) * s.vibration_angle.low + share * s.vibration_angle.high;
            for (int k = 1; k <= 40; ++k) {
                double const omega = std::sqrt(s.max_machine_number * k / 40 * s.gravity / amplitude);
                theory::Drive const d{omega / (2 * pi), amplitude, beta, 0};
                if (d.frequency < s.frequency.low || d.frequency > s.frequency.high || excess(s, d) > 0)
                    continue;
                double const eta = theory::solve(point_of(d, friction)).velocity_efficiency;
                fastest = std::max(fastest, eta * d.trough_speed());
            }
        }
    }
    return fastest;
}

// Without uncertainty the fastest design is that of the theory: none on a grid is faster, but for what
// rounding the drive may cost (0.5 %), and the grid comes near it.
TEST(RiskDesign, WithoutRiskItIsTheFastestDesign) {
    DesignTask task = pellets();
    task.friction = normal_friction(0.3, 0);
    task.models = {point_mass_design_model(0)};
    double const fastest = fastest_on_a_grid(task.space, 0.3);
    double const speed = design_with_risk(task).forecasts.front().median_speed;
    EXPECT_GE(speed, 0.995 * fastest);
    EXPECT_LE(speed, 1.02 * fastest);
}

// Each objective is better in its own terms than the fastest design, and still reaches the mass flow.
TEST(RiskDesign, ObjectivesAreBetterInTheirOwnTerms) {
    DesignTask task = pellets();
    auto const power = [](RiskDesign const& d) { return d.power_per_mass * d.depth; };
    RiskDesign const fastest = design_with_risk(task);
    task.objective = Objective::gentlest_landing;
    RiskDesign const gentle = design_with_risk(task);
    task.objective = Objective::least_machine_number;
    RiskDesign const weak = design_with_risk(task);
    task.objective = Objective::least_power;
    RiskDesign const thrifty = design_with_risk(task);
    EXPECT_LT(gentle.landing_speed, fastest.landing_speed);
    EXPECT_LT(weak.machine_number, fastest.machine_number);
    EXPECT_LT(power(thrifty), power(fastest));
    for (RiskDesign const& d : {gentle, weak, thrifty}) {
        EXPECT_TRUE(d.feasible);
        EXPECT_GE(d.probability, 0.95);
    }
}

// Two models: both must reach the mass flow, so that the design is at most as fast as with one of them.
TEST(RiskDesign, AllModelsMustReachTheMassFlow) {
    DesignTask task = pellets();
    double const alone = design_with_risk(task).sure_speed;
    task.models.push_back(rolling_layer_design_model(Uncertain{0}, 0.1));
    RiskDesign const d = design_with_risk(task);
    ASSERT_EQ(d.forecasts.size(), 2U);
    EXPECT_LE(d.sure_speed, alone * 1.001);
    EXPECT_GE(d.throw_number, 1.25);  // where the law was tested
    EXPECT_LE(d.throw_number, 2.6);
    for (ModelForecast const& f : d.forecasts) EXPECT_GE(f.probability, 0.95) << f.model;
    EXPECT_THAT(d.warnings, testing::IsEmpty());  // the theory is not alone
}

TEST(RiskDesign, SaysWhenItCannotBeReached) {
    DesignTask task = pellets();
    task.mass_flow = 1000 / 3.6;
    RiskDesign const d = design_with_risk(task);
    EXPECT_FALSE(d.feasible);
    EXPECT_LT(d.probability, 0.05);
    EXPECT_THAT(d.active_limits, testing::Contains(testing::HasSubstr("layer depth")));
    EXPECT_THAT(first_sentence(task, d),
                testing::StartsWith("No machine within the limits carries 1000 t/h"));
}

// A machine number of 0.5 with an error of 0.1 of the trough's speed conveys nothing with 95 %. The machine
// is then the one that carries most at an even chance, and no weaker one: here it carries as much as any of a
// grid of drives does by the point mass, but for the steps of a workshop.
TEST(RiskDesign, WithoutASureSpeedItIsTheLikeliest) {
    DesignTask task = pellets();
    task.space.max_machine_number = 0.5;
    RiskDesign const d = design_with_risk(task);
    EXPECT_FALSE(d.feasible);
    EXPECT_LE(d.sure_flow, 0);
    double best = 0;
    for (double frequency = task.space.frequency.low; frequency <= task.space.frequency.high;
         frequency += 1) {
        for (double angle = task.space.vibration_angle.low; angle < task.space.vibration_angle.high;
             angle += 0.05) {
            double const omega = 2 * pi * frequency;
            theory::Drive const drive{
                frequency, std::min(task.space.amplitude.high, 0.5 * 9.81 / (omega * omega)), angle, 0};
            if (drive.amplitude < task.space.amplitude.low) continue;
            best = std::max(best,
                            theory::solve(point_of(drive, 0.3)).velocity_efficiency * drive.trough_speed());
        }
    }
    EXPECT_GT(d.forecasts.front().median_speed, 0.97 * best);
    EXPECT_EQ(d.depth, task.depth.high);
    EXPECT_THAT(design_text(task, d), testing::Not(testing::HasSubstr("in operation")));
}

TEST(RiskDesign, WarnsWhereTheTheoryAloneIsWrong) {
    DesignTask task = pellets();
    task.space.max_throw_number = 1.7;
    RiskDesign const d = design_with_risk(task);
    EXPECT_THAT(d.warnings, testing::ElementsAre(testing::HasSubstr("why_theory_fails")));
}

// With grains of which the layer is four deep a probability is given; with grains of which it is twenty deep,
// or without a word about the grains, the first sentence, the table and the JSON say that none is known.
TEST(RiskDesign, ADeeperLayerThanTestedHasNoProbability) {
    for (DesignModel const& model : {point_mass_design_model(), rolling_layer_design_model()}) {
        DesignTask task = pellets();
        task.models = {model};
        task.depth = {0.036, 0.04};
        task.grain_diameter = 0.01;
        RiskDesign const tested = design_with_risk(task);
        EXPECT_FALSE(tested.untested) << *tested.untested;
        EXPECT_THAT(design_text(task, tested), testing::StartsWith("This trough carries 12 t/h with a prob"));
        EXPECT_TRUE(tested.warnings.empty() || model.is_point_mass);
        task.grain_diameter.reset();
        RiskDesign const unknown = design_with_risk(task);
        EXPECT_FALSE(unknown.feasible);
        EXPECT_THAT(first_sentence(task, unknown), testing::HasSubstr("--grain-diameter"));
        task.grain_diameter = 0.0019;
        RiskDesign const deep = design_with_risk(task);
        EXPECT_FALSE(deep.feasible);
        std::string const text = design_text(task, deep);
        EXPECT_THAT(text,
                    testing::StartsWith("Not tested: no probability is known that this trough carries"));
        EXPECT_THAT(text, testing::ContainsRegex(" not known +[0-9.]+ +not known +not known\n"));
        auto const json = design_json(task, deep);
        EXPECT_TRUE(json.at("probability").is_null());
        EXPECT_TRUE(json.at("models").at(0).at("probability").is_null());
        EXPECT_THAT(json.at("untested").get<std::string>(), testing::ContainsRegex("(19|20|21)"));
    }
}

// A discrepancy that the user states replaces the table, but not the range in which the law was tested.
TEST(RiskDesign, AStatedDiscrepancyIsTheUsersOwn) {
    DesignTask task = pellets();
    task.grain_diameter = 0.001;
    task.models = {point_mass_design_model(0.05)};
    EXPECT_FALSE(design_with_risk(task).untested);
    task.models = {rolling_layer_design_model(Uncertain{0}, 0.05)};
    task.depth = {0.03, 0.04};
    EXPECT_TRUE(design_with_risk(task).untested);
}

// Daesung's own example: 10 mm at 600 per minute give 22.86 m/min. Without slip a material that flies for a
// whole cycle (n = 1) on a level trough has g cot(beta) / (2 f).
TEST(RiskDesign, RulesOfThumb) {
    EXPECT_NEAR(60 * rule_of_daesung({10, 0.01, 0.5, 0}), 22.86, 1e-9);
    double const beta = 0.5, whole = std::sqrt(1 + pi * pi);
    double const frequency = std::sqrt(whole * 9.81 / (0.005 * std::sin(beta))) / (2 * pi);
    EXPECT_NEAR(speed_without_slip({frequency, 0.005, beta, 0}), 9.81 / std::tan(beta) / (2 * frequency),
                1e-6);
    EXPECT_EQ(speed_without_slip({5, 0.001, beta, 0}), 0);
    // A friction without end holds the mass on the trough: the theory then is the rule.
    theory::Drive const d{12, 0.006, 0.5, 0.05};
    EXPECT_NEAR(speed_without_slip(d), theory::solve(point_of(d, 1e4)).velocity_efficiency * d.trough_speed(),
                1e-3);
}

// Draws of a normal distribution give the distribution back; the discrepancy beside each friction goes along.
TEST(RiskDesign, PosteriorIsReadAsItsDistribution) {
    std::vector<double> friction, discrepancy;
    KnownFriction const exact = normal_friction(0.3, 0.02);
    for (int i = 0; i < 4000; ++i) {
        double const u = (i + 0.5) / 4000, w = std::fmod(i * 0.6180339887498949, 1.0);
        friction.push_back(0.3 + 0.02 * std::sqrt(-2 * std::log(u)) * std::cos(2 * pi * w));
        discrepancy.push_back(friction.back() > 0.3 ? 0.04 : 0.01);
    }
    KnownFriction const known = drawn_friction(friction, discrepancy);
    EXPECT_NEAR(known.median, 0.3, 0.001);
    EXPECT_NEAR(known.low, exact.low, 0.004);
    EXPECT_NEAR(known.high, exact.high, 0.004);
    auto const parts = known.parts(few_parts(0.95)), exact_parts = exact.parts(few_parts(0.95));
    ASSERT_EQ(parts.size(), exact_parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        EXPECT_NEAR(parts[i].friction, exact_parts[i].friction, 0.003) << i;
        EXPECT_NEAR(parts[i].share, exact_parts[i].share, 1e-3) << i;
    }
    EXPECT_EQ(parts.front().discrepancies, std::vector<double>(160, 0.01));  // 4 % of the draws
    EXPECT_EQ(parts.back().discrepancies, std::vector<double>(160, 0.04));
    EXPECT_THROW(drawn_friction({0.3, 0.4}, {}), std::invalid_argument);
}

TEST(RiskDesign, SenselessTasksAreRefused) {
    DesignTask task = pellets();
    task.bulk_density = 0;
    EXPECT_THROW(design_with_risk(task), std::invalid_argument);
    task = pellets();
    task.confidence = 1;
    EXPECT_THROW(design_with_risk(task), std::invalid_argument);
    task = pellets();
    task.models.clear();
    EXPECT_THROW(design_with_risk(task), std::invalid_argument);
    task = pellets();
    task.space.inclination = {0.4, 0.5};  // steeper than the lowest friction
    EXPECT_THROW(design_with_risk(task), std::invalid_argument);
    EXPECT_THROW(normal_friction(0, 0.1), std::invalid_argument);
    // Of 400 draws, four lie beyond 99 %.
    task = pellets();
    std::vector<double> draws;
    for (int i = 0; i < 400; ++i) draws.push_back(0.3 + 1e-4 * i);
    task.friction = drawn_friction(draws, {});
    task.confidence = 0.99;
    EXPECT_THROW(design_with_risk(task), core::InputError);
    task.confidence = 0.9875;
    EXPECT_NO_THROW(design_with_risk(task));
}

}  // namespace
}  // namespace vibrotrough::learn
