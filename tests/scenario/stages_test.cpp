#include "scenario/model/stages.hpp"

#include "core/error.hpp"
#include "example_campaign.hpp"
#include "scenario/model/stage_motion.hpp"
#include "scenario/reader/written_campaign.hpp"
#include "single_case.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough {
namespace {

using scenario::Scenario;
using scenario::Stage;
using testing::HasSubstr;

/// The example at 10 Hz with these stages, which decide how long its run is.
std::string with_stages(std::string const& text) {
    return with("throw_number = 2.0", "frequency = \"10 Hz\"", with("max_cycles = 200\n", "")) + text;
}

std::string const up_and_down = R"([[stages]]
ramp = "0.4 s"
time = "1.4 s"

[[stages]]
ramp_cycles = 3
cycles = 9
frequency = "20 Hz"
stroke = "4 mm"
along_phase = "30 deg"

[[stages]]
standstill = true
ramp_cycles = 2
cycles = 5

[[stages]]
cycles = 4
vibration_angle = "45 deg"
)";

TEST(Stages, TakeFromTheOneBeforeWhatTheyDoNotGive) {
    Scenario const s = single_case(with_stages(up_and_down));
    std::vector<Stage> const all = stages(s);
    ASSERT_EQ(all.size(), 4u);
    EXPECT_EQ(all[0].ramp_cycles, 4);
    EXPECT_EQ(all[0].cycles, 14);
    EXPECT_EQ(all[1].first_cycle, 14);
    EXPECT_EQ(all[1].trough.amplitude, 2e-3);
    EXPECT_EQ(all[1].first_frequency, 10);
    // Three cycles while the frequency grows from 10 to 20 Hz take 3 / 15 s, and six take 6 / 20 s.
    EXPECT_NEAR(all[2].start - all[1].start, 0.5, 1e-12);
    EXPECT_TRUE(all[2].standstill);
    EXPECT_EQ(all[3].trough.frequency, 20);
    EXPECT_EQ(all[3].first_frequency, 20);
    EXPECT_EQ(s.measure.max_cycles, 32);
    EXPECT_EQ(cycle_durations(all).size(), 32u);
}

TEST(Stages, AThrowNumberIsKeptWhenOnlyTheAmplitudeChanges) {
    std::string const text =
        with("max_cycles = 200\n", "") + "[[stages]]\ncycles = 5\namplitude = \"3 mm\"\n";
    Stage const stage = stages(single_case(text)).front();
    EXPECT_EQ(throw_number(stage.trough), 2);
    EXPECT_NEAR(machine_number(stage.trough),
                std::pow(2 * std::numbers::pi * stage.trough.frequency, 2) * 3e-3 / scenario::gravity, 1e-12);
}

TEST(Stages, AreReadAsTheyAreWritten) {
    Scenario const s = single_case(with_stages(up_and_down));
    std::string const text = to_toml(s);
    EXPECT_EQ(to_toml(single_case(text)), text);
    EXPECT_THAT(text, HasSubstr("standstill = true"));
}

// The position is continuous everywhere; the velocity is, too, but where a drive changes without a ramp. The
// velocity is the derivative of the position.
TEST(Stages, TheTroughMovesContinuously) {
    auto const parts = drive_parts(stages(single_case(with_stages(up_and_down))));
    ASSERT_EQ(parts.size(), 7u);
    constexpr double tiny = 1e-9;
    for (scenario::DrivePart const& part : parts) {
        auto const before = trough_at(parts, part.start - tiny), after = trough_at(parts, part.start + tiny);
        EXPECT_NEAR(before.x, after.x, 1e-8);
        EXPECT_NEAR(before.z, after.z, 1e-8);
        EXPECT_NEAR(after.x, 0, 1e-8) << "at the beginning of a cycle";
        if (part.start == 0 || &part == &parts.back()) continue;  // from rest, at once
        EXPECT_NEAR(before.vx, after.vx, 1e-5);
        EXPECT_NEAR(before.vz, after.vz, 1e-5);
    }
    double const end = parts.back().start + parts.back().time;
    for (double t = 0.013; t < end; t += 0.0171) {
        constexpr double h = 1e-6;
        auto const left = trough_at(parts, t - h), right = trough_at(parts, t + h),
                   here = trough_at(parts, t);
        EXPECT_NEAR((right.x - left.x) / (2 * h), here.vx, 1e-6) << t;
        EXPECT_NEAR((right.z - left.z) / (2 * h), here.vz, 1e-6) << t;
    }
}

TEST(Stages, AReversedTroughMovesBackwards) {
    std::string const text = "[[stages]]\ncycles = 2\n[[stages]]\ncycles = 2\nalong_phase = \"180 deg\"\n";
    auto const parts = drive_parts(stages(single_case(with_stages(text))));
    for (double const t : {0.01, 0.05, 0.12}) {
        EXPECT_NEAR(trough_at(parts, t).x, -trough_at(parts, t + 0.2).x, 1e-15);
        EXPECT_NEAR(trough_at(parts, t).z, trough_at(parts, t + 0.2).z, 1e-15);
    }
}

// Steps of all cycles are equally many, and the time of a step follows from the part it is in.
TEST(Stages, TheTimeOfAStepFollowsFromItsCycle) {
    auto const parts = drive_parts(stages(single_case(with_stages(up_and_down))));
    EXPECT_NEAR(time_of_step(parts, 100, 350), 0.35, 1e-12);
    EXPECT_NEAR(time_of_step(parts, 100, 1550), 1.4 + 1.5 / 15, 1e-12);
}

TEST(Stages, ARampMayTakeTheWholeStage) {
    auto const text = [](int ramp) {
        return with_stages(fmt::format("[[stages]]\nramp_cycles = {}\ncycles = 5\n", ramp));
    };
    EXPECT_EQ(stages(single_case(text(5))).front().ramp_cycles, 5);
    EXPECT_THROW(single_case(text(6)), core::InputError);
}

}  // namespace
}  // namespace vibrotrough
