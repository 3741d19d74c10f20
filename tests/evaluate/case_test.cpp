#include "evaluate/case.hpp"

#include "campaign/campaign_folder.hpp"
#include "core/error.hpp"
#include "store/result_file.hpp"

namespace vibrotrough::campaign {
namespace {

/// eta with an even scatter of 0.01 about `mean`: steady, uncorrelated from cycle to cycle on average.
auto around(double mean, double scatter = 0.01) {
    return [=](int k) { return mean + (k % 2 == 0 ? scatter : -scatter); };
}

auto ramp(int k) {
    return 0.2 + 0.01 * k;
}

class Assemble : public CampaignFolder {
  protected:
    void write_packings(std::string const& first, std::string const& second) const {
        write_packing(1, first, {3.5, "2026-11-21T12:00:05Z", "2026-11-21T12:00:20Z"});
        write_packing(2, second, {4.0, "2026-11-21T12:00:00Z", "2026-11-21T12:00:10Z"});
    }
    std::string cycles(int count, std::function<double(int)> const& eta) const {
        return cycles_text(scenario, count, eta);
    }
    store::CaseRecord assembled() const {
        evaluate::EvaluatedPackings packings;
        for (int const packing : {1, 2}) {
            auto one = evaluate::read_packing(*planned.prepared, packing, planned.packing_folder(packing));
            if (one) packings.emplace(packing, std::move(*one));
        }
        return evaluate::evaluate_case(*planned.prepared, planned.id, "LIGGGHTS 3.8.0", std::move(packings));
    }
};

TEST_F(Assemble, MeasuresWhatTheCyclesSay) {
    write_packings(cycles(60, around(0.5)), cycles(60, around(0.6)));
    store::CaseRecord const record = assembled();
    EXPECT_EQ(record.outcome, core::Outcome::finished);
    ASSERT_EQ(record.packings.size(), 2u);
    auto const& estimate = record.packings[0].estimate;
    // x is written with 15 digits of 0.018 m ... 1 m: 1e-15 of it in a displacement of 0.016 m.
    EXPECT_NEAR(estimate.mean, 0.5, 1e-12);
    EXPECT_NEAR(record.packings[1].estimate.mean, 0.6, 1e-12);
    // 20 cycles with s = 0.01 sqrt(20/19): t_19 s / sqrt(20), t_19 = 2.0930 for 95 % from any table.
    EXPECT_NEAR(estimate.half_width, 2.0930 * 0.01 / std::sqrt(19), 1e-6);
    EXPECT_EQ(estimate.discarded, 0);
    EXPECT_EQ(estimate.verdict, measure::Verdict::precise);
    // The case: mean of the means, and t_1 = 12.706 of their deviation 0.0707 over sqrt(2).
    EXPECT_NEAR(record.estimate.mean.value(), 0.55, 1e-12);
    EXPECT_NEAR(record.estimate.half_width.value(), 12.706 * 0.1 / 2, 1e-4);
    EXPECT_EQ(record.estimate.packings, 2);
}

TEST_F(Assemble, KeepsOnlyTheCyclesNeeded) {
    // The engine had run on, by 40 cycles and by 1, before it was told to stop.
    write_packings(cycles(60, around(0.5)), cycles(21, around(0.5)));
    for (store::PackingRecord const& packing : assembled().packings) {
        EXPECT_EQ(packing.series.cycles(), 20);
        EXPECT_EQ(packing.series.x.size(), 21u);
        EXPECT_EQ(packing.efficiency.size(), 20u);
        EXPECT_EQ(packing.estimate.measured, 20);
    }
    auto const result = [&] { return assembled().packings[0].efficiency; };
    auto const before = result();
    write_packing(1, cycles(37, around(0.5)));
    EXPECT_EQ(result(), before) << "the answer must not depend on when the driver looked";
}

TEST_F(Assemble, SaysWhenTheLayerIsNotSteady) {
    write_packings(cycles(60, ramp), cycles(60, around(0.5)));
    EXPECT_EQ(assembled().outcome, core::Outcome::not_steady);
    EXPECT_EQ(assembled().packings[0].series.cycles(), 60)
        << "all cycles belong to an answer that was not found";
}

TEST_F(Assemble, SaysWhenTheMeanIsNotPrecise) {
    write_packings(cycles(60, around(0.5)), cycles(60, around(0.5, 0.3)));
    store::CaseRecord const record = assembled();
    EXPECT_EQ(record.outcome, core::Outcome::not_precise);
    EXPECT_EQ(record.packings[1].series.cycles(), 60);
    EXPECT_GT(record.packings[1].estimate.half_width, scenario.measure.half_width);
    // The case cannot be better known than its worst packing.
    EXPECT_GE(record.estimate.half_width.value(), record.packings[1].estimate.half_width);
}

TEST_F(Assemble, NotSteadyOutweighsNotPrecise) {
    write_packings(cycles(60, around(0.5, 0.3)), cycles(60, ramp));
    EXPECT_EQ(assembled().outcome, core::Outcome::not_steady);
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
    EXPECT_TRUE(evaluate::read_packing(*planned.prepared, 1, planned.packing_folder(1)));
    EXPECT_FALSE(evaluate::read_packing(*planned.prepared, 2, planned.packing_folder(2)));
    // What was changed after the marker was written does not count either.
    overwrite(planned.packing_folder(1) / "cycles.csv", cycles(30, around(0.6)));
    EXPECT_FALSE(evaluate::read_packing(*planned.prepared, 1, planned.packing_folder(1)));
    EXPECT_FALSE(evaluate::estimate_finished(*planned.prepared, planned.packing_folder(1)));
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

TEST_F(Assemble, EnoughCyclesAsTheEstimateSays) {
    auto const is_enough = [&](int count, auto const& eta) {
        write_packing(1, cycles(count, eta));
        return evaluate::estimate_so_far(*planned.prepared, planned.packing_folder(1)).is_enough;
    };
    EXPECT_FALSE(is_enough(19, around(0.5)));
    EXPECT_TRUE(is_enough(20, around(0.5)));
    EXPECT_TRUE(is_enough(33, around(0.5))) << "enough once is enough for ever";
    EXPECT_FALSE(is_enough(60, around(0.5, 0.3)));
    EXPECT_FALSE(is_enough(60, ramp));
}

// The estimate of a finished packing is that of its record.
TEST_F(Assemble, AnEstimateNeedsTheCyclesAlone) {
    write_packings(cycles(60, around(0.5)), cycles(40, around(0.6, 0.02)));
    store::CaseRecord const record = assembled();
    for (int const packing : {1, 2}) {
        auto const estimate = evaluate::estimate_finished(*planned.prepared, planned.packing_folder(packing));
        ASSERT_TRUE(estimate);
        EXPECT_EQ(estimate->mean, record.packings[static_cast<std::size_t>(packing - 1)].estimate.mean);
    }
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

}  // namespace
}  // namespace vibrotrough::campaign
