#include "compare/stage_rows.hpp"

#include "compare/exports.hpp"
#include "compare/table.hpp"
#include "store/sample_record.hpp"
#include "theory/point_mass.hpp"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough::compare {
namespace {

/// The sample with a stage of its drive, one of twice the amplitude at the same frequency, and a standstill.
scenario::Scenario with_stages() {
    scenario::Scenario scenario = store::sample_record("0123456789ab").scenario;
    double const frequency = scenario.trough.frequency;
    scenario.stages = {{.cycles = 10},
                       {.cycles = 20, .ramp_cycles = 5, .amplitude = 0.012, .frequency = frequency},
                       {.cycles = 5, .standstill = true}};
    return scenario;
}

std::vector<Row> rows_of(scenario::Scenario const& scenario) {
    store::CaseRecord record{};
    record.scenario = scenario;
    return stage_rows("0123456789ab", prepare::prepare_case(scenario), record, "open");
}

// The efficiency of a drive in stages is a mean over all of them: a curve of the theory beside it would be
// for another drive.
TEST(StageRows, CasesWithStagesHaveNoCurveOfTheTheory) {
    scenario::Scenario scenario = with_stages();
    Row const staged = compare("", prepare::prepare_case(scenario), {}, "open");
    scenario.stages.clear();
    scenario.trough.vibration_angle *= 1.5;
    Row const steady = compare("", prepare::prepare_case(scenario), {}, "open");
    auto const lines = [](std::vector<Row> const& rows) {
        return std::ranges::count(theory_curves_csv(rows), '\n');
    };
    EXPECT_EQ(lines({staged}), 1) << "the names of the columns";
    EXPECT_EQ(lines({staged, steady}), lines({steady}));
    EXPECT_GT(lines({steady}), 100);
}

std::optional<double> number(Row const& row, std::string_view name) {
    auto const columns = stage_columns();
    auto const column = std::ranges::find(columns, name, &Column::name);
    EXPECT_NE(column, columns.end()) << name;
    auto const value = column->of(row);
    return value ? std::optional(std::get<double>(*value)) : std::nullopt;
}

// v = eta omega r cos(beta), with eta of the point mass at the throw number of the stage.
TEST(StageRows, TheTheoryIsThatOfTheDriveOfTheStage) {
    scenario::Scenario const scenario = with_stages();
    auto const rows = rows_of(scenario);
    ASSERT_EQ(rows.size(), 3u);
    for (std::size_t i = 0; i < 2; ++i) {
        scenario::Trough trough = scenario.trough;
        trough.amplitude *= i == 0 ? 1 : 2;
        theory::Motion const motion = theory::solve({.throw_number = throw_number(trough),
                                                     .tan_vibration_angle = std::tan(trough.vibration_angle),
                                                     .tan_inclination = std::tan(trough.inclination),
                                                     .friction = trough.friction});
        ASSERT_TRUE(motion.converged);
        double const speed = motion.velocity_efficiency * angular_frequency(trough) * trough.amplitude *
                             std::cos(trough.vibration_angle);
        EXPECT_NEAR(number(rows[i], "speed_theory_m_per_s").value(), speed, 1e-9 * speed);
        EXPECT_NEAR(number(rows[i], "throw_number").value(), throw_number(trough), 1e-9);
    }
    EXPECT_FALSE(number(rows[2], "speed_theory_m_per_s"));
    EXPECT_EQ(number(rows[2], "throw_number"), 0);
    EXPECT_FALSE(number(rows[1], "conveying_speed_m_per_s"));  // nothing has been measured
}

TEST(StageRows, ASpeedStandsBesideTheTheoryWithItsInterval) {
    auto const rows = [] {
        auto const scenario = with_stages();
        store::CaseRecord record{};
        record.scenario = scenario;
        auto const durations = cycle_durations(stages(scenario));
        for (double const speed : {0.1, 0.2}) {
            store::PackingRecord packing{};
            packing.series.x = {0};
            for (double const duration : durations)
                packing.series.x.push_back(packing.series.x.back() + speed * duration);
            record.packings.push_back(packing);
        }
        return stage_rows("0123456789ab", prepare::prepare_case(scenario), record, "finished");
    }();
    EXPECT_NEAR(number(rows[1], "conveying_speed_m_per_s").value(), 0.15, 1e-12);
    // Student's t for two packings, 12.706, times 0.0707 / sqrt(2).
    EXPECT_NEAR(number(rows[1], "conveying_speed_half_width_m_per_s").value(), 0.63531, 1e-5);
    EXPECT_THAT(to_table(rows, {}, stage_columns()), testing::HasSubstr("0.1500 +- 0.6353"));
    EXPECT_THAT(to_csv(rows, stage_columns()), testing::HasSubstr("case,stage,start_s,time_s"));
}

}  // namespace
}  // namespace vibrotrough::compare
