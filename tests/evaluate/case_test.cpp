#include "evaluate/case.hpp"

#include "campaign/campaign_folder.hpp"
#include "core/error.hpp"
#include "evaluate/open_trough.hpp"
#include "scenario/reader/written_campaign.hpp"
#include "store/result_file.hpp"

#include <gmock/gmock.h>

namespace vibrotrough::campaign {
namespace {

/// eta with an even scatter of 0.01 about `mean`: steady, uncorrelated from cycle to cycle on average.
auto around(double mean, double scatter = 0.01) {
    return [=](int k) { return mean + (k % 2 == 0 ? scatter : -scatter); };
}

auto ramp(int k) {
    return 0.2 + 0.01 * k;
}

/// A campaign folder whose case leaves room for its numerical errors (5 MPa, 12 x 6 diameters).
class Assemble : public CampaignFolder {
  protected:
    Assemble() {
        campaign_text = with("half_width = 0.02", "half_width = 0.08", campaign_text);
        plan = make_plan(scenario::parse_campaign(campaign_text, "campaign.toml"), folder, "LIGGGHTS 3.8.0");
        planned = plan.cases.front();
        scenario = planned.scenario();
    }
    void write_packings(std::string const& first, std::string const& second) const {
        write_packing(1, first, {3.5, "2026-11-21T12:00:05Z", "2026-11-21T12:00:20Z"});
        write_packing(2, second, {4.0, "2026-11-21T12:00:00Z", "2026-11-21T12:00:10Z"});
    }
    std::string cycles(int count, std::function<double(int)> const& eta) const {
        return cycles_text(scenario, count, eta);
    }
    store::CaseRecord assembled(int cycles = 20) const {
        evaluate::EvaluatedPackings packings;
        for (int const packing : {1, 2}) {
            auto one =
                evaluate::read_packing(*planned.prepared, packing, planned.packing_folder(packing), cycles);
            if (one) packings.emplace(packing, std::move(*one));
        }
        return evaluate::evaluate_case(*planned.prepared, planned.id, "LIGGGHTS 3.8.0", std::move(packings));
    }
};

TEST_F(Assemble, MeasuresWhatTheCyclesSay) {
    write_packings(cycles(60, around(0.5)), cycles(60, around(0.6)));
    store::CaseRecord const record = assembled();
    EXPECT_EQ(record.outcome, core::Outcome::not_precise) << "both packings are precise, but they differ";
    ASSERT_EQ(record.packings.size(), 2u);
    auto const& estimate = record.packings[0].estimate;
    // x is written with 15 digits of 0.018 m ... 1 m: 1e-15 of it in a displacement of 0.016 m.
    EXPECT_NEAR(estimate.mean, 0.5, 1e-12);
    EXPECT_NEAR(record.packings[1].estimate.mean, 0.6, 1e-12);
    // 20 cycles with s = 0.01 sqrt(20/19): t_19 s / sqrt(20), t_19 = 2.0930 for 95 % from any table.
    EXPECT_NEAR(estimate.half_width, 2.0930 * 0.01 / std::sqrt(19), 1e-6);
    EXPECT_EQ(estimate.discarded, 0);
    EXPECT_EQ(estimate.verdict, measure::Verdict::precise);
    // The case: mean of the means, and t_1 = 25.452 of their deviation 0.0707 over sqrt(2), at the level
    // 1 - 0.5 x 0.05: t_1 = tan(pi (0.9875 - 0.5)) is exact for one degree of freedom.
    EXPECT_NEAR(record.estimate.mean.value(), 0.55, 1e-12);
    double const quantile = std::tan(std::numbers::pi * 0.4875);
    EXPECT_NEAR(record.estimate.half_width.value(), quantile * 0.1 / 2, 1e-9);
    EXPECT_EQ(record.estimate.packings, 2);
}

TEST_F(Assemble, KeepsOnlyTheCyclesThatAreUsed) {
    write_packings(cycles(60, around(0.5)), cycles(21, around(0.5)));
    for (store::PackingRecord const& packing : assembled().packings) {
        EXPECT_EQ(packing.series.cycles(), 20);
        EXPECT_EQ(packing.series.x.size(), 21u);
        EXPECT_EQ(packing.efficiency.size(), 20u);
        EXPECT_EQ(packing.estimate.measured, 20);
    }
    EXPECT_THROW(assembled(30), core::InputError) << "the second packing has 21 cycles";
}

TEST_F(Assemble, IsFinishedOnlyWhenTheCaseIsPrecise) {
    write_packings(cycles(60, around(0.5)), cycles(60, around(0.5)));
    EXPECT_EQ(assembled().outcome, core::Outcome::finished);
    write_packings(cycles(60, around(0.5)), cycles(60, around(0.5, 0.3)));
    store::CaseRecord const record = assembled();
    EXPECT_EQ(record.outcome, core::Outcome::not_precise);
    EXPECT_GT(record.estimate.half_width.value(), scenario.measure.half_width);
    EXPECT_THAT(evaluate::remark_on(record), testing::HasSubstr("more than it has"));
}

// The packings agree better than was asked, but box and softness leave no room: 0.08 is more than what was
// asked.
TEST_F(Assemble, IsNotFinishedWhenTheNumericsAreNotPrecise) {
    write_packings(cycles(60, around(0.5)), cycles(60, around(0.5)));
    store::CaseRecord record = assembled();
    double const numerics = record.numerical_error().value();
    record.scenario.measure.half_width = 1.001 * std::hypot(*record.estimate.half_width, numerics);
    EXPECT_EQ(evaluate::outcome_of(record.estimate, record.scenario), core::Outcome::finished);
    record.scenario.measure.half_width = 0.999 * numerics;
    EXPECT_LT(*record.estimate.half_width, numerics);
    record.outcome = evaluate::outcome_of(record.estimate, record.scenario);
    EXPECT_EQ(record.outcome, core::Outcome::not_precise);
    EXPECT_THAT(evaluate::remark_on(record), testing::HasSubstr("the numerical errors alone may be"));
}

TEST_F(Assemble, SaysWhenTheLayerIsNotSteady) {
    write_packings(cycles(60, ramp), cycles(60, ramp));
    store::CaseRecord const record = assembled(60);
    EXPECT_EQ(record.outcome, core::Outcome::not_steady);
    EXPECT_FALSE(record.estimate.mean);
}

TEST_F(Assemble, SaysWhereItComesFrom) {
    write_packings(cycles(30, around(0.5)), cycles(30, around(0.5)));
    store::CaseRecord const record = assembled();
    EXPECT_EQ(record.id, planned.id);
    EXPECT_EQ(record.scenario_toml, to_toml(scenario));
    EXPECT_EQ(record.provenance.engine_version, "LIGGGHTS 3.8.0");
    EXPECT_EQ(record.provenance.started, "2026-11-21T12:00:00Z") << "the earlier of the two";
    EXPECT_EQ(record.provenance.finished, "2026-11-21T12:00:20Z") << "the later of the two";
    EXPECT_EQ(record.packings[0].deck, "# deck 1\n");
    EXPECT_EQ(record.packings[1].deck, "# deck 2\n");
    EXPECT_EQ(record.packings[0].wall_time, 3.5);
    EXPECT_NE(record.packings[0].seed, record.packings[1].seed);
    EXPECT_EQ(record.packings[1].steps_per_cycle, planned.prepared->time.steps_per_cycle);
    EXPECT_EQ(record.packings[1].mass, planned.prepared->mass);
}

TEST_F(Assemble, IsWhatTheStoreGivesBack) {
    write_packings(cycles(30, around(0.5)), cycles(30, around(0.6)));
    store::CaseRecord const record = assembled();
    store::write_result(planned.result_file(), record);
    auto const read = read_whole_result(planned);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->outcome, record.outcome);
    EXPECT_EQ(read->estimate.mean, record.estimate.mean);
    EXPECT_EQ(read->packings[1].efficiency, record.packings[1].efficiency);
}

// v = 1 m/s is faster than the trough (omega r = 0.5 m/s) at all times: a layer that slides for ever.
TEST_F(Assemble, MeasuresTheLayer) {
    write_packings(cycles(60, around(0.5)), cycles(60, around(0.6)));
    store::CaseRecord const record = assembled();
    EXPECT_EQ(record.layer_mode, "P");
    EXPECT_EQ(record.packings[1].motion.mode, "P");
    EXPECT_NEAR(record.packings[0].motion.friction_ratio.value(), 0.01 / 0.09, 1e-12);
    EXPECT_EQ(record.packings[0].motion.curves.phase.size(), 100u);
    EXPECT_EQ(record.packings[0].motion.largest_overlap, 2e-6);
    EXPECT_EQ(record.packings[0].profiles.solid_fraction,
              (std::vector<double>{700 / scenario.grains.density}));
    EXPECT_EQ(record.packings[0].surface.height, (std::vector<double>{0.004}));
}

TEST_F(Assemble, AnUnfinishedPackingIsNone) {
    write_packing(1, cycles(30, around(0.5)));
    EXPECT_TRUE(evaluate::read_packing(*planned.prepared, 1, planned.packing_folder(1), 20));
    EXPECT_FALSE(evaluate::read_packing(*planned.prepared, 2, planned.packing_folder(2), 20));
    // What was changed after the marker was written does not count either.
    overwrite(planned.packing_folder(1) / "cycles.csv", cycles(30, around(0.6)));
    EXPECT_FALSE(evaluate::read_packing(*planned.prepared, 1, planned.packing_folder(1), 20));
    EXPECT_FALSE(evaluate::read_finished_cycles(*planned.prepared, planned.packing_folder(1)));
}

TEST_F(Assemble, RefusesDamagedCycles) {
    std::string const good = cycles(30, around(0.5));
    scenario::Scenario other = scenario;
    other.layer.grains -= 1;
    std::string const lost_grain = cycles_text(other, 30, around(0.5));
    std::string const short_line = good + "1,2,3\n";
    std::string const last_line = good.substr(good.rfind('\n', good.size() - 2) + 1);
    std::string const twice = good + last_line;
    for (std::string const& damaged : {lost_grain, short_line, twice, std::string("no table\n")}) {
        write_packings(damaged, good);
        EXPECT_THROW(assembled(), core::InputError) << damaged.substr(0, 100);
    }
}

TEST_F(Assemble, TheCyclesOfAFinishedPackingAreThoseOfItsRecord) {
    write_packings(cycles(60, around(0.5)), cycles(40, around(0.6, 0.02)));
    store::CaseRecord const record = assembled(40);
    auto const finished = evaluate::read_finished_cycles(*planned.prepared, planned.packing_folder(2));
    ASSERT_TRUE(finished);
    EXPECT_EQ(finished->efficiency, record.packings[1].efficiency);
    EXPECT_EQ(evaluate::read_efficiency(*planned.prepared, planned.packing_folder(2), 40),
              record.packings[1].efficiency);
    EXPECT_THROW(evaluate::read_efficiency(*planned.prepared, planned.packing_folder(2), 41),
                 core::InputError);
}

TEST_F(Assemble, ARunThatDivergedIsSeen) {
    write_packing(1, cycles(5, around(0.5)));
    auto extent = evaluate::extent_of_run(*planned.prepared, planned.packing_folder(1));
    EXPECT_EQ(extent.cycles, 5);
    EXPECT_FALSE(extent.diverged);
    overwrite(planned.packing_folder(1) / "cycles.csv", cycles(5, around(0.5)) + "9,1,nan,0,0,0,0,0,0\n");
    extent = evaluate::extent_of_run(*planned.prepared, planned.packing_folder(1));
    EXPECT_TRUE(extent.diverged);
}

// The engine says at which step it ended: a table with fewer cycles, or with more, is not what it wrote.
TEST_F(Assemble, ATableThatDoesNotEndWithTheEngineIsIncomplete) {
    write_packing(1, cycles(60, around(0.5)));
    auto const files = evaluate::read_packing_files(planned.packing_folder(1));
    auto const is_incomplete = [&](long last_cycle) {
        auto const found = evaluate::evaluate_outputs(*planned.prepared, 1, files,
                                                      last_cycle * planned.prepared->time.steps_per_cycle);
        auto const* const unusable = std::get_if<evaluate::UnusableOutputs>(&found);
        return unusable != nullptr && unusable->outcome == core::Outcome::outputs_incomplete;
    };
    EXPECT_TRUE(is_incomplete(59));
    EXPECT_FALSE(is_incomplete(60)) << "what these files lack is weight";
    EXPECT_TRUE(is_incomplete(61));
}

// What leaves an open trough is compared with what comes: 2 % and the interval of the packings are allowed.
TEST(OpenTrough, IsSteadyWhereAsMuchLeavesAsComes) {
    store::CaseRecord record{};
    record.scenario.measure.confidence = 0.95;
    record.packings.resize(2);
    auto const message = [&](double outflow) {
        for (store::PackingRecord& packing : record.packings) {
            packing.open.inflow = 2;
            packing.open.outflow = outflow;
        }
        return evaluate::unsteady_flow(record);
    };
    EXPECT_EQ(message(2), "");
    EXPECT_EQ(message(2.03), "");
    EXPECT_EQ(message(1.8).substr(0, 38), "the outflow is 10 % less than the infl");
    EXPECT_EQ(message(2.2).substr(0, 38), "the outflow is 10 % more than the infl");
}

}  // namespace
}  // namespace vibrotrough::campaign
