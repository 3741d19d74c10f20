#include "measure/wear.hpp"

#include "campaign/campaign_folder.hpp"
#include "core/error.hpp"
#include "evaluate/case.hpp"
#include "evaluate/packing.hpp"
#include "store/quantity.hpp"
#include "store/result_file.hpp"

#include <gmock/gmock.h>

namespace vibrotrough::campaign {
namespace {

/// A campaign folder whose case asks for the wear, with two packings of 24 cycles.
class MeasuredWear : public CampaignFolder {
  protected:
    MeasuredWear() {
        campaign_text =
            with("half_width = 0.02", "half_width = 0.08", campaign_text);  // with room for numerics
        campaign_text = with("max_cycles = 200", "max_cycles = 200\nwear = true", campaign_text);
        plan = make_plan(scenario::parse_campaign(campaign_text, "campaign.toml"), folder, "LIGGGHTS 3.8.0");
        planned = plan.cases.front();
        scenario = planned.scenario();
    }

    std::filesystem::path file(int packing, int cycle) const {
        return planned.packing_folder(packing) /
               measure::wear_file(static_cast<long>(cycle) * planned.prepared->time.steps_per_cycle);
    }

    /// Both packings as an engine that ended well leaves them: each cycle wears 0.25 J/m^2 in the first,
    /// twice as much in the second.
    void write_packings() const {
        for (int const packing : {1, 2}) {
            for (int cycle = 0; cycle <= 60; ++cycle)
                overwrite(file(packing, cycle),
                          fmt::format("POINTS 3 float\n0 0 0 0.003 0 0 0 0.003 0 \nmeshid 1 1 int\n0 \n"
                                      "wear 1 1 double\n{} \narea 1 1 double\n4.5e-06 \n",
                                      3 + 0.25 * packing * cycle));
            write_packing(packing, cycles_text(scenario, 60, [](int k) { return k % 2 == 0 ? 0.51 : 0.49; }));
        }
    }

    store::CaseRecord assembled() const {
        evaluate::EvaluatedPackings packings;
        for (int const packing : {1, 2}) {
            auto one =
                evaluate::read_packing(*planned.prepared, packing, planned.packing_folder(packing), 24);
            if (one) packings.emplace(packing, std::move(*one));
        }
        return evaluate::evaluate_case(*planned.prepared, planned.id, "LIGGGHTS 3.8.0", std::move(packings));
    }

    static double value(store::CaseRecord const& record, std::string_view name) {
        for (store::Quantity const& one : store::quantities())
            if (one.name == name) return std::get<std::optional<double>>(one.of_case(record)).value_or(-1);
        return -2;
    }
};

// The cycles kept do not matter, because each wears the same.
TEST_F(MeasuredWear, IsInTheRecordAndInItsFile) {
    write_packings();
    store::CaseRecord const record = assembled();
    ASSERT_EQ(record.packings.size(), 2u);
    double const frequency = scenario.trough.frequency, speed = 0.5 * planned.prepared->velocity_scale;
    EXPECT_NEAR(record.packings[0].wear.rate.value(), 0.25 * frequency, 1e-10);
    EXPECT_NEAR(value(record, "wear_rate"), 0.375 * frequency, 1e-10);
    // Of an area of 4.5e-6 m^2, over the mass of the layer times its speed.
    double const expected = 0.375 * frequency * 4.5e-6 / (planned.prepared->mass * speed);
    EXPECT_NEAR(value(record, "specific_wear") / expected, 1, 0.01);  // an odd number of cycles may be kept
    EXPECT_GT(value(record, "specific_wear_half_width"), 0);

    std::filesystem::create_directories(folder);
    store::write_result(folder / "result.h5", record);
    store::CaseRecord const read = store::read_result(folder / "result.h5");
    EXPECT_EQ(read.packings[1].wear.triangle_rates, record.packings[1].wear.triangle_rates);
    EXPECT_EQ(read.packings[1].wear.per_conveyed, record.packings[1].wear.per_conveyed);
    EXPECT_EQ(read.packings[1].wear.area, std::vector{4.5e-6});
}

// A packing whose snapshots were changed after its run is run again.
TEST_F(MeasuredWear, IsOfTheRun) {
    write_packings();
    overwrite(file(1, 24), "changed");
    EXPECT_EQ(assembled().packings.size(), 1u);
}

TEST_F(MeasuredWear, NeedsAllSnapshots) {
    write_packings();
    std::filesystem::remove(file(1, 24));
    evaluate::write_marker(evaluate::read_packing_files(planned.packing_folder(1)), {});
    try {
        assembled();
        FAIL() << "no error";
    } catch (core::InputError const& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr(".vtk is missing; run its case again"));
    }
}

}  // namespace
}  // namespace vibrotrough::campaign
