#include "atlas/atlas.hpp"
#include "learn/atlas_design_model.hpp"
#include "learn/design_campaign.hpp"
#include "learn/design_report.hpp"
#include "learn/risk_design.hpp"
#include "prepare/prepared_case.hpp"
#include "scenario/reader/campaign_file.hpp"
#include "theory/random_number.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

// What a person may rely on who changes one number of a task after the other.
namespace vibrotrough::learn {
namespace {

using theory::between;

theory::Range part_of(double low, double high) {
    double const a = between(low, high), b = between(low, high);
    return {std::min(a, b), std::max(a, b)};
}

/// What plants ask for, as `vibrotrough design --grain-diameter` makes its task: the atlas decides, and the
/// point mass stands in where it knows no layer.
DesignTask any_plant() {
    DesignTask task{};
    double const size = std::exp(between(std::log(0.001), std::log(0.02)));
    task.grain_diameter = size;
    task.rolling_friction = between(0, 0.2);
    double const speed = *rc::gen::element(546.0, 730.0, 960.0, 1450.0) / 60;
    task.space.frequency = *rc::gen::arbitrary<bool>() ? theory::Range{speed, speed} : part_of(8, 30);
    task.space.amplitude = part_of(0.0005, 0.01);
    task.space.vibration_angle = part_of(0.2, 0.9);
    if (*rc::gen::arbitrary<bool>()) task.space.inclination = part_of(-0.1, 0.1);
    task.space.max_machine_number = between(2, 6);
    task.depth = part_of(size, 25 * size);
    task.friction = normal_friction(between(0.25, 0.5), *rc::gen::element(0.0, 0.0, 0.03));
    task.bulk_density = between(400, 1800);
    task.width = between(0.2, 1.2);
    task.mass_flow = std::exp(between(std::log(1.0), std::log(100.0))) / 3.6;
    task.models = {atlas_design_model({size, Uncertain{*task.rolling_friction}}, 0, task.friction.median)};
    task.stand_in = point_mass_design_model();
    return task;
}

void widen(theory::Range& range, double least, double most) {
    double const length = range.high - range.low + 0.1 * (most - least);
    range.low = std::max(least, range.low - between(0, 1) * length);
    range.high = std::min(most, range.high + between(0, 1) * length);
}

/// One range or several of a task made wider.
DesignTask widened(DesignTask task) {
    unsigned const which = *rc::gen::inRange(1U, 64U);
    double const size = *task.grain_diameter;
    if (which & 1U) widen(task.depth, size, 30 * size);
    if (which & 2U) widen(task.space.amplitude, 0.0005, 0.015);
    if (which & 4U) widen(task.space.frequency, 5, 50);
    if (which & 8U) widen(task.space.vibration_angle, 0.15, 1.0);
    if (which & 16U) widen(task.space.inclination, -0.1, 0.1);
    if (which & 32U) task.space.max_machine_number += between(0, 2);
    return task;
}

/// kg/s, that is surely carried; 0 where nothing is known, or no machine keeps the limits.
double sure_flow(DesignTask const& task, RiskDesign* design = nullptr) {
    try {
        RiskDesign const found = design_with_risk(task);
        if (design != nullptr) *design = found;
        return found.untested ? 0 : found.sure_flow;
    } catch (std::invalid_argument const&) {
        return 0;
    }
}

// The mass flow that is wanted is so large that none is reached, so that the machine which comes nearest is
// looked for. Tolerance: the workshop's steps may cost half a percent of each (`largest_loss`), and both
// searches stop within half a percent of the best layer.
RC_GTEST_PROP(DesignRanges, AWiderRangeIsNeverWorse, ()) {
    DesignTask task = any_plant();
    task.mass_flow = 1e4;
    double const narrow = sure_flow(task), wide = sure_flow(widened(task));
    RC_ASSERT(wide >= 0.99 * narrow);
}

// What carries the mass flow still does with wider limits, and the width that a failure names is enough.
RC_GTEST_PROP(DesignRanges, TheWidthThatIsNamedIsEnough, ()) {
    DesignTask task = any_plant();
    RiskDesign design{};
    if (sure_flow(task, &design) <= 0) return;
    if (design.feasible) {
        RC_ASSERT(design_with_risk(widened(task)).feasible);
        return;
    }
    RC_ASSERT(design.width_needed.has_value());
    task.width = std::ceil(1e3 * *design.width_needed) / 1e3;  // as it is printed
    RC_ASSERT(design_with_risk(task).feasible);
}

// The campaign that checks a design is the design: predicted by the atlas as `vibrotrough predict` does, its
// layer at the median of the friction is as fast as the design says. Tolerance: the ten digits of the file.
RC_GTEST_PROP(DesignRanges, TheCampaignIsTheDesign, ()) {
    DesignTask const task = any_plant();
    RiskDesign design{};
    if (sure_flow(task, &design) <= 0) return;
    RC_ASSERT(!why_no_campaign(task, design));
    auto const campaign = scenario::parse_campaign(design_campaign(task, design, {}), "check.toml");
    int compared = 0;
    for (scenario::Scenario const& one : campaign.cases) {
        if (std::abs(one.trough.friction - task.friction.median) > 1e-6) continue;
        ++compared;
        auto const answer = atlas::predict(prepare::prepare_case(one));
        RC_ASSERT(answer.efficiency.has_value());
        RC_ASSERT(std::abs(*answer.efficiency - design.forecasts.front().efficiency->efficiency) < 1e-4);
        RC_ASSERT(std::abs(scenario::layer_height(one) - design.depth) < 1e-9);
        RC_ASSERT(std::abs(*one.trough.width - task.width) < 1e-9);
        RC_ASSERT(std::abs(one.grains.diameter - *task.grain_diameter) < 1e-9);
    }
    RC_ASSERT(compared == 1);
}

/// Rock of 40 mm in a layer of two diameters on a machine that exists.
DesignTask rock() {
    constexpr double degree = std::numbers::pi / 180;
    DesignTask task{};
    task.space.frequency = {16, 16};
    task.space.amplitude = {0.00485, 0.00485};
    task.space.vibration_angle = {30 * degree, 30 * degree};
    task.depth = {0.08, 0.08};
    task.friction = normal_friction(0.5, 0);
    task.bulk_density = 1600;
    task.width = 0.8;
    task.mass_flow = 140 / 3.6;
    task.grain_diameter = 0.04;
    task.rolling_friction = 0.2;
    task.models = {atlas_design_model({0.04, Uncertain{0.2}}, 0, 0.5)};
    task.stand_in = point_mass_design_model();
    return task;
}

// Its own layer carries 136 +- 5 t/h, where 139 to 165 t/h was printed before the atlas had such layers. Both
// intervals, of 95 %, are combined in squares.
TEST(DesignRanges, ALayerOfTwoDiametersIsAsFastAsItsOwnSimulation) {
    DesignTask const task = rock();
    RiskDesign const design = design_with_risk(task);
    EXPECT_FALSE(design.feasible);
    EXPECT_FALSE(design.untested);
    EXPECT_FALSE(why_no_campaign(task, design));
    ModelForecast const& said = design.forecasts.front();
    EXPECT_NEAR(3.6 * said.median_flow, 136, std::hypot(3.6 * (said.high_flow - said.low_flow) / 2, 5));
}

// So thin a layer was not simulated.
TEST(DesignRanges, ALayerOfOneAndAHalfDiametersHasNoProbability) {
    DesignTask task = rock();
    task.depth = {0.06, 0.06};
    RiskDesign const design = design_with_risk(task);
    EXPECT_FALSE(design.feasible);
    EXPECT_THAT(first_sentence(task, design), testing::StartsWith("Not tested: no probability is known"));
    EXPECT_THAT(design.untested.value(), testing::HasSubstr("and not"));
}

// Where the simulation would need another layer there is no file, but a reason.
TEST(DesignRanges, ALayerThatCannotBeSimulatedHasNoCampaign) {
    DesignTask task = rock();
    task.depth = {0.06, 0.06};
    RiskDesign const design = design_with_risk(task);
    EXPECT_THAT(why_no_campaign(task, design).value(), testing::HasSubstr("1.5 diameters of a grain deep"));
    EXPECT_THROW(design_campaign(task, design, {}), std::invalid_argument);
    task.grain_diameter.reset();
    EXPECT_THAT(why_no_campaign(task, design).value(), testing::HasSubstr("--grain-diameter"));
}

// Of frictions that were partly not simulated, more than a twentieth, no probability is known.
TEST(DesignRanges, FrictionsThatWereNotSimulatedHaveNoProbability) {
    DesignTask task = rock();
    task.depth = {0.2, 0.3};
    task.space.amplitude = {0.02, 0.03};
    task.space.frequency = {6, 8};
    task.friction = normal_friction(0.3, 0.03);
    EXPECT_FALSE(design_with_risk(task).untested);
    task.friction = normal_friction(0.2, 0.05);
    EXPECT_THAT(design_with_risk(task).untested.value(), testing::HasSubstr("frictions of 0.15 to 0.6"));
}

}  // namespace
}  // namespace vibrotrough::learn
