#include "evaluate/rolling.hpp"

#include "campaign/campaign_folder.hpp"
#include "core/error.hpp"
#include "evaluate/case.hpp"
#include "store/result_file.hpp"

#include <algorithm>

#include <gmock/gmock.h>

namespace vibrotrough::campaign {
namespace {

using testing::HasSubstr;

/// A campaign folder whose case asks for the contacts at the floor, with two packings of 24 cycles.
class MeasuredRolling : public CampaignFolder {
  protected:
    MeasuredRolling() {
        campaign_text =
            with("half_width = 0.02", "half_width = 0.08", campaign_text);  // with room for numerics
        campaign_text = with("max_cycles = 200", "max_cycles = 200\nrolling = true", campaign_text);
        plan = make_plan(scenario::parse_campaign(campaign_text, "campaign.toml"), folder, "LIGGGHTS 3.8.0");
        planned = plan.cases.front();
        scenario = planned.scenario();
    }

    std::filesystem::path file(int packing) const { return planned.packing_folder(packing) / "rolling.csv"; }

    /// rolling.csv with 8 contacts, 6 of which slide.
    std::string lines(int cycles) const {
        int const steps = 3 * (planned.prepared->time.steps_per_cycle / 100);
        std::string text =
            "step,loaded,sliding,friction,torque,contacts,all_contacts,first,first_vx,first_spin,second,"
            "second_vx,"
            "second_spin,first_volume,second_volume,floor_x,floor_z,floor_torque\n";
        for (int line = 1; 3 * line <= 100 * cycles; ++line)
            text += fmt::format("{},8,6,0.3,0.05,12,28,5,20,10,4,12,2,6e-9,8e-9,-0.2,2,0.01\n", line * steps);
        return text;
    }

    /// Both packings as an engine that ended well leaves them, the first with this rolling.csv.
    void write_packings(std::string const& first) const {
        for (int const packing : {1, 2}) {
            overwrite(file(packing), packing == 1 ? first : lines(60));
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

    /// The packing counts with its efficiency, and there is one line about what is missing.
    void expect_problem(std::string const& words) const {
        store::CaseRecord const record = assembled();
        ASSERT_EQ(record.packings.size(), 2u) << words;
        EXPECT_NEAR(record.estimate.mean.value(), 0.5, 1e-12);
        EXPECT_TRUE(record.packings[0].rolling.phase.empty());
        EXPECT_EQ(record.packings[1].rolling.phase.size(), 100u);
        std::string const remark = evaluate::remark_on(record);
        EXPECT_THAT(remark, testing::AllOf(HasSubstr("packing 1: the contacts at the floor are unknown"),
                                           HasSubstr(words), HasSubstr("run again")));
        EXPECT_EQ(std::ranges::count(remark, '\n'), 0);
        // It is in the result, too.
        auto const path = folder / "result.h5";
        std::filesystem::create_directories(folder);
        store::write_result(path, record);
        EXPECT_EQ(evaluate::remark_on(store::read_result(path)), remark);
    }
};

TEST_F(MeasuredRolling, IsInTheRecord) {
    write_packings(lines(60));
    store::CaseRecord const record = assembled();
    ASSERT_EQ(record.packings.size(), 2u);
    for (store::PackingRecord const& packing : record.packings) {
        EXPECT_EQ(packing.rolling_problem, "");
        ASSERT_EQ(packing.rolling.sliding_share.size(), 100u);
        EXPECT_EQ(packing.rolling.sliding_share[7], 0.75);
        // 6e-9 m^3 in 36 mm x 18 mm x 3 mm
        EXPECT_NEAR(packing.rolling.first_fraction[7], 6e-9 / (0.036 * 0.018 * 0.003), 1e-15);
    }
    EXPECT_EQ(evaluate::remark_on(record), "");
}

TEST_F(MeasuredRolling, CostsNoEfficiencyWhenItIsMissingCutOrDamaged) {
    write_packings("");
    expect_problem("(rolling.csv is missing)");
    write_packings(lines(10));
    expect_problem("(rolling.csv holds 333 lines and should hold 800 for 24 cycles)");
    write_packings(lines(60).replace(lines(60).find("\n") + 20, 3, "abc"));
    expect_problem("(rolling.csv:2: the line is damaged");
}

// What was changed after the run is not what the engine wrote, even if it can be read.
TEST_F(MeasuredRolling, IsThatOfTheRun) {
    write_packings(lines(60));
    std::string text = lines(60);
    overwrite(file(1), text.replace(text.find(",8,6,"), 5, ",8,7,"));
    expect_problem("(rolling.csv was changed after the run)");
}

// Without the key a file of this name means nothing.
TEST_F(CampaignFolder, NothingIsMeasuredThatWasNotAskedFor) {
    overwrite(planned.packing_folder(1) / "rolling.csv", "nonsense");
    write_packing(1, cycles_text(scenario, 60, [](int k) { return k % 2 == 0 ? 0.51 : 0.49; }));
    auto const one = evaluate::read_packing(*planned.prepared, 1, planned.packing_folder(1), 24);
    ASSERT_TRUE(one);
    EXPECT_TRUE(one->record.rolling.phase.empty());
    EXPECT_EQ(one->record.rolling_problem, "");
}

}  // namespace
}  // namespace vibrotrough::campaign
