#include "campaign/state/numerics_results.hpp"

#include "campaign/state/overview.hpp"
#include "campaign_folder.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "store/result_file.hpp"
#include "store/sample_record.hpp"

#include <nlohmann/json.hpp>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;
using prepare::NumericalSetting;

/// Four throw numbers at two frictions: eight cases.
std::string const sweep = R"(
[sweep]
"trough.throw_number" = [1.0, 1.5, 2.0, 3.0]
"trough.friction" = [0.2, 0.3]
)";

class Numerics : public CampaignFolder {
  protected:
    Numerics() { fs::create_directories(folder); }

    Plan plan_of(std::string const& text) const {
        return make_plan(scenario::parse_campaign(text, "campaign.toml"), folder, "LIGGGHTS 3.8.0");
    }

    /// A budget whose only part is an error of the length.
    static evaluate::NumericsBudget budget(std::string const& id, double error) {
        evaluate::StudyResult const standard{id, 0.8, 0.001, ""};
        evaluate::SettingError length{NumericalSetting::length, 0.036, {}, {}, {}, ""};
        length.variations = {{0.072, 0.5, {"ba9876543210", 0.8 - error, 0.001, ""}, error, 0}};
        length.error = {measure::Convergence::resolved, error, 0};
        return {id, 0.95, standard, {length}};
    }

    core::TemporaryFolder const other;
    Plan swept = plan_of(campaign_text + sweep);
};

TEST_F(Numerics, FirstMiddleAndLastRepresentACampaign) {
    using Numbers = std::vector<std::size_t>;
    EXPECT_EQ(representative_cases(0), Numbers{});
    EXPECT_EQ(representative_cases(1), Numbers{0});
    EXPECT_EQ(representative_cases(2), (Numbers{0, 1}));
    EXPECT_EQ(representative_cases(3), (Numbers{0, 1, 2}));
    EXPECT_EQ(representative_cases(100), (Numbers{0, 49, 99}));
}

TEST_F(Numerics, AStudyIsTheCaseWithoutFramesAndItsVariations) {
    Plan const filmed = plan_of(with("frames_per_cycle = 0", "frames_per_cycle = 12", campaign_text));
    NumericsStudy const study = plan_study(filmed.cases.front(), 0.005);
    EXPECT_EQ(study.case_id, filmed.cases.front().id);
    auto const scenarios = study.scenarios();
    ASSERT_EQ(scenarios.size(), 6u);
    for (scenario::Scenario const& one : scenarios) {
        EXPECT_EQ(one.output.frames_per_cycle, 0);
        EXPECT_EQ(one.measure.half_width, 0.005);
    }
    EXPECT_EQ(scenarios[1].grains.youngs_modulus, 4 * scenarios[0].grains.youngs_modulus.value());
    EXPECT_EQ(plan_study(filmed.cases.front(), {}).standard.scenario.measure.half_width,
              filmed.cases.front().scenario().measure.half_width);
}

// Results are found by what they are, and what has none says why.
TEST_F(Numerics, MeasuresWhatIsFinished) {
    NumericsStudy const study = plan_study(planned, {});
    Plan all{"study", folder, "LIGGGHTS 3.8.0", {}, {}};
    for (scenario::Scenario const& one : study.scenarios())
        all.cases.push_back(plan_case(one, folder, "LIGGGHTS 3.8.0"));
    for (std::size_t const number : {0, 1, 2}) {
        auto record = store::sample_record(all.cases[number].id);
        record.outcome = core::Outcome::finished;
        record.estimate = {0.8 + 0.01 * static_cast<double>(number), 0.001, 2};
        fs::create_directories(all.cases[number].folder);
        store::write_result(all.cases[number].result_file(), record);
    }
    fs::create_directories(all.cases[3].folder);
    write_failure(all.cases[3], {core::Outcome::lost_grains, "a grain is gone", 1, 1});
    auto unsteady = store::sample_record(all.cases[4].id);
    unsteady.outcome = core::Outcome::not_steady;
    fs::create_directories(all.cases[4].folder);
    store::write_result(all.cases[4].result_file(), unsteady);

    auto const budgets = measure_numerics(all, {study});
    ASSERT_EQ(budgets.size(), 1u);
    auto const& settings = budgets[0].settings;
    EXPECT_NEAR(*settings[0].variations[1].error, 0.8 - 0.82, 1e-15);  // one rounding
    EXPECT_TRUE(settings[0].error);
    EXPECT_NE(settings[1].message.find("lost-grains: a grain is gone"), std::string::npos);
    EXPECT_NE(settings[2].message.find("not-steady"), std::string::npos);
    EXPECT_NE(settings[3].message.find("not finished"), std::string::npos);
    EXPECT_FALSE(budgets[0].numerical_error());
}

TEST_F(Numerics, UsesNoBudgetThatIsUnknown) {
    EXPECT_TRUE(read_case_numerics(folder).empty()) << "there is no file";
    auto unknown = budget(swept.cases[0].id, 0.01);
    unknown.settings[0].error.reset();
    write_numerics(folder, {unknown});
    EXPECT_TRUE(read_case_numerics(folder).empty());
}

TEST_F(Numerics, KeepsTheBudgetsOfOtherCases) {
    write_numerics(folder, {budget(swept.cases[0].id, 0.01), budget(swept.cases[1].id, 0.02)});
    write_numerics(folder, {budget(swept.cases[1].id, 0.03)});
    auto const known = read_case_numerics(folder);
    EXPECT_EQ(known.at(swept.cases[0].id), 0.01);
    EXPECT_EQ(known.at(swept.cases[1].id), 0.03) << "studied again";
}

TEST_F(Numerics, DocumentsItselfInTheFile) {
    auto with_gap = budget("0123456789ab", -0.03);
    with_gap.settings.push_back(
        {NumericalSetting::width, 0.018, {}, {}, {}, "between side walls the width is part of the problem"});
    write_numerics(folder, {with_gap});
    auto const json = nlohmann::json::parse(core::read_file(numerics_file(folder)));
    EXPECT_EQ(json.at("format"), "vibrotrough numerics");
    auto const& one = json.at("cases").at(0);
    EXPECT_EQ(one.at("numerical_error"), 0.03);
    EXPECT_EQ(one.at("settings").at(0).at("verdict"), "resolved");
    EXPECT_EQ(one.at("settings").at(0).at("error"), -0.03);
    EXPECT_EQ(one.at("settings").at(0).at("bound"), 0.03);
    EXPECT_EQ(one.at("settings").at(0).at("variations").at(0).at("value"), 0.072);
    EXPECT_EQ(one.at("settings").at(1).at("verdict"), "left-out");
    EXPECT_EQ(one.at("settings").at(1).at("bound"), 0.0);
}

TEST_F(Numerics, DamageIsSaidInOneLine) {
    for (char const* damaged :
         {"", "[", "[]", "{}", "{\"format\": \"vibrotrough numerics\"}",
          "{\"format\": \"vibrotrough numerics\", \"schema_version\": 1, \"cases\": 3}",
          "{\"format\": \"vibrotrough numerics\", \"schema_version\": 1, \"cases\": [{}]}",
          "{\"format\": \"vibrotrough numerics\", \"schema_version\": 1, \"cases\": [1]}"}) {
        overwrite(numerics_file(folder), damaged);
        EXPECT_THROW(read_case_numerics(folder), core::InputError) << damaged;
    }
}

// campaign.h5 is written again when it does not hold what a study found.
TEST_F(Numerics, MakesTheCampaignFileOutdated) {
    fs::create_directories(planned.folder);
    store::write_result(planned.result_file(), store::sample_record(planned.id));
    write_campaign_file(plan);
    EXPECT_FALSE(is_campaign_file_outdated(plan));
    write_numerics(folder, {budget(planned.id, 0.01)});
    EXPECT_TRUE(is_campaign_file_outdated(plan));
}

}  // namespace
}  // namespace vibrotrough::campaign
