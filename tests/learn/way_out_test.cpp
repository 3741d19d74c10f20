#include "learn/design_report.hpp"
#include "learn/pellets.hpp"
#include "learn/risk_design.hpp"

#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::learn {
namespace {

// The way out that a failed design tells is one: with the width that it gives the mass flow is reached, and
// with 2 % less it is not; so it is by each of the troughs.
TEST(WayOut, AFailedDesignTellsTheWayOut) {
    DesignTask task = pellets();
    task.mass_flow = 1200 / 3.6;
    RiskDesign const d = design_with_risk(task);
    ASSERT_FALSE(d.feasible);
    ASSERT_TRUE(d.width_needed);
    auto const json = design_json(task, d);
    int const troughs = json.at("troughs_needed");
    EXPECT_THAT(first_sentence(task, d),
                testing::AllOf(testing::HasSubstr(std::to_string(troughs) + " troughs side by side"),
                               testing::Not(testing::HasSubstr("0.0 %"))));
    DesignTask wide = task, narrow = task, shared = task, fewer = task;
    wide.width = *d.width_needed * 1.002;
    narrow.width = *d.width_needed * 0.98;
    shared.mass_flow = task.mass_flow / troughs;
    fewer.mass_flow = task.mass_flow / (troughs - 1);
    EXPECT_TRUE(design_with_risk(wide).feasible);
    EXPECT_FALSE(design_with_risk(narrow).feasible);
    EXPECT_TRUE(design_with_risk(shared).feasible);
    EXPECT_FALSE(design_with_risk(fewer).feasible);
}

/// What a task is refused with.
std::string refusal(DesignTask const& task) {
    try {
        design_with_risk(task);
    } catch (std::invalid_argument const& error) {
        return error.what();
    }
    return "";
}

// A limit that excludes every machine is named, with the value that lets one through. The law begins at a
// throw number of 1.25 and ends at tan(beta) = 0.75, sin(beta) = 0.6: a machine number of 1.25 / 0.6 = 2.083.
TEST(WayOut, TheLimitInTheWayIsNamed) {
    DesignTask task = pellets();
    task.models = {rolling_layer_design_model(Uncertain{0}, 0.05)};
    task.space.max_machine_number = 1.5;
    EXPECT_THAT(refusal(task), testing::AllOf(testing::HasSubstr("throw numbers of 1.25 to 2.6"),
                                              testing::HasSubstr("a machine number of 2.09 or more")));
    // omega^2 r / g <= 4 at 2900 turns per minute: r <= 0.4255 mm.
    task = pellets();
    task.space.frequency = {2900.0 / 60, 2900.0 / 60};
    EXPECT_THAT(refusal(task),
                testing::AllOf(testing::HasSubstr("a stroke of 0.85 mm or less"),
                               testing::HasSubstr("a machine number of 4.71 or more"),
                               testing::HasSubstr("a speed of the drive of 2670 1/min or less")));
    task.space.amplitude.low = 0.00085 / 2;
    EXPECT_EQ(refusal(task), "");
}

// Of the speeds that can be had the best is taken: it is what a design at this speed alone gives, and no
// other gives more. What excludes one of them is told.
TEST(WayOut, ChoosesAmongTheSpeedsThatCanBeHad) {
    DesignTask task = pellets();
    task.frequencies = {960.0 / 60, 1450.0 / 60, 2900.0 / 60};
    RiskDesign const d = design_with_risk(task);
    ASSERT_EQ(d.choices.size(), 3U);
    EXPECT_THAT(d.choices.back().why_none, testing::HasSubstr("a stroke of 0.85 mm or less"));
    for (std::size_t i = 0; i < 2; ++i) {
        DesignTask one = task;
        one.frequencies.clear();
        one.space.frequency = {task.frequencies[i], task.frequencies[i]};
        RiskDesign const alone = design_with_risk(one);
        EXPECT_EQ(alone.sure_speed, d.choices[i].design->sure_speed);
        EXPECT_LE(alone.sure_speed, d.sure_speed);
    }
    EXPECT_EQ(d.drive.frequency, 960.0 / 60);
    EXPECT_THAT(design_text(task, d), testing::ContainsRegex("\n1450 +[0-9.]+ +[0-9.]+ +[0-9.]+"));
    auto const json = design_json(task, d);
    EXPECT_EQ(json.at("speeds_compared").size(), 3U);
    task.frequencies = {2900.0 / 60};
    EXPECT_THAT(refusal(task), testing::HasSubstr("at 2900 1/min the limits"));
}

}  // namespace
}  // namespace vibrotrough::learn
