#include "compare/contrasts.hpp"

#include "compare/exports.hpp"
#include "compare/table.hpp"
#include "core/error.hpp"
#include "prepare/numerical_errors.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"
#include "store/sample_record.hpp"

#include <cmath>
#include <memory>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::compare {
namespace {

using testing::HasSubstr;

/// The example campaign without the lines of the keys that are swept, because a key is given once.
std::string without_swept(std::string const& sweep) {
    std::string text;
    std::istringstream lines(example_campaign);
    std::string section;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("[")) section = line.substr(1, line.find(']') - 1);
        std::string const key = "\"" + section + "." + line.substr(0, line.find(' ')) + "\"";
        if (sweep.find(key) == std::string::npos) text += line + "\n";
    }
    return text;
}

/// A campaign of made-up results, whose efficiencies are 0.80, 0.81, 0.82 ... +- 0.002 in each packing.
struct MadeUp {
    campaign::Plan plan;
    ComparedCases compared;

    explicit MadeUp(std::string const& sweep) {
        scenario::Campaign const campaign =
            scenario::parse_campaign(without_swept(sweep) + "\n[sweep]\n" + sweep + "\n", "c");
        plan.swept = campaign.swept;
        for (scenario::Scenario const& one : campaign.cases) {
            auto const prepared = std::make_shared<prepare::PreparedCase const>(prepare::prepare_case(one));
            plan.cases.push_back(
                {.id = "case-" + std::to_string(plan.cases.size()), .prepared = prepared, .folder = {}});
        }
        for (campaign::PlannedCase const& one : plan.cases) add(one);
        compared.columns = columns_with_swept(plan.swept);
    }

    void add(campaign::PlannedCase const& planned) {
        store::CaseRecord record = store::sample_record(planned.id);
        record.scenario = planned.scenario();
        record.estimate.mean = 0.80 + 0.01 * static_cast<double>(compared.rows.size());
        record.estimate.deviation = 0.002;
        record.estimate.drift = 0;
        record.estimate.packings = 4;
        Row row = compare(planned.id, *planned.prepared, record, "");
        for (scenario::Key const* const key : plan.swept)
            row.swept.push_back(swept_value(planned.scenario(), *key));
        compared.rows.push_back(std::move(row));
        compared.estimates.push_back(record.estimate);
        compared.cases.push_back({&planned, campaign::CaseStatus::ended, record.outcome, "", 4, {}});
    }

    nlohmann::json json(std::vector<Row> const& rows) const {
        return nlohmann::json::parse(to_json(rows, contrast_columns(compared.columns, plan.swept)));
    }
};

// Differences of 0.01 beside a statistical half-width of 2.9687 * 0.002 / sqrt(2) = 0.0042 (four packings
// each: 6 degrees of freedom), while the bounds of the numerical errors are above 0.02.
TEST(Contrasts, ErrorsThatCasesShareCancel) {
    MadeUp const made("\"trough.restitution\" = [0.2, 0.5, 0.8]");
    auto const json = made.json(contrast_rows_of(made.plan, made.compared, "trough.restitution"));
    ASSERT_EQ(json.size(), 2);
    EXPECT_EQ(json[0]["case"], "case-1");
    EXPECT_EQ(json[0]["against"], "case-0");
    EXPECT_EQ(json[1]["against"], "case-0") << "each less the first";
    EXPECT_NEAR(json[0]["efficiency_difference"], 0.01, 1e-12);
    EXPECT_NEAR(json[1]["efficiency_difference"], 0.02, 1e-12);
    EXPECT_EQ(json[0]["efficiency_difference_numerics"], 0.0);
    EXPECT_NEAR(json[0]["efficiency_difference_half_width"], 2.9687 * 0.002 / std::sqrt(2.0), 1e-6);
    EXPECT_EQ(json[0]["significant"], "yes");
    EXPECT_EQ(json[0]["trough.restitution"], 0.5) << "swept keys tell the cases apart";
    EXPECT_GT(made.compared.rows[0].number("efficiency_numerics").value(), 0.02);
}

// A box of another length, a time step and another drive do not cancel: the bounds of both add in squares.
TEST(Contrasts, ErrorsOfOtherSettingsAdd) {
    for (std::string const sweep :
         {"\"layer.length\" = [\"36 mm\", \"48 mm\"]", "\"trough.throw_number\" = [1.5, 2.0]",
          "\"solver.rayleigh_fraction\" = [0.1, 0.2]"}) {
        MadeUp const made(sweep);
        Row const &one = made.compared.rows[0], &other = made.compared.rows[1];
        auto const json = made.json(contrast_rows_against(made.compared, "case-0"));
        ASSERT_EQ(json.size(), 1) << sweep;
        double const both = std::hypot(one.number("efficiency_numerics").value(),
                                       other.number("efficiency_numerics").value());
        EXPECT_NEAR(json[0]["efficiency_difference_numerics"], both, 1e-12) << sweep;
        EXPECT_EQ(json[0]["significant"], "no") << sweep;
    }
}

// Softer grains alone: the box and the step are the same, and the bounds of softness add in squares.
TEST(Contrasts, AnotherModulusCountsAlone) {
    MadeUp const made("\"grains.youngs_modulus\" = [\"5 MPa\", \"10 MPa\"]");
    auto const softness = [&](std::size_t i) {
        return prepare::numerical_errors(made.plan.cases[i].scenario()).softness;
    };
    auto const json = made.json(contrast_rows_against(made.compared, "case-1"));
    EXPECT_NEAR(json[0]["efficiency_difference_numerics"], std::hypot(softness(0), softness(1)), 1e-12);
    EXPECT_NEAR(json[0]["efficiency_difference"], -0.01, 1e-12);
}

TEST(Contrasts, AreBetweenCasesThatDifferInOneKey) {
    MadeUp const made("\"trough.throw_number\" = [1.5, 2.0]\n\"grains.friction\" = [0.3, 0.5]");
    auto const json = made.json(contrast_rows_of(made.plan, made.compared, "grains.friction"));
    ASSERT_EQ(json.size(), 2);
    for (auto const& row : json) EXPECT_EQ(row["efficiency_difference_numerics"], 0.0);
    EXPECT_NE(json[0]["against"], json[1]["against"]);
}

TEST(Contrasts, OfCasesWithoutAMeanAreUnknown) {
    MadeUp made("\"trough.restitution\" = [0.2, 0.5]");
    made.compared.rows[1].set("efficiency", {});
    auto const rows = contrast_rows_of(made.plan, made.compared, "restitution");
    auto const json = made.json(rows);
    EXPECT_TRUE(json[0]["efficiency_difference"].is_null());
    EXPECT_TRUE(json[0]["significant"].is_null());
    EXPECT_THAT(to_table(rows, {}, contrast_columns(made.compared.columns, made.plan.swept)),
                HasSubstr("case-0"));
}

TEST(Contrasts, SayWhatDoesNotExist) {
    MadeUp const made("\"trough.restitution\" = [0.2, 0.5]");
    try {
        contrast_rows_of(made.plan, made.compared, "trough.friction");
        FAIL();
    } catch (core::InputError const& error) {
        EXPECT_THAT(error.what(), HasSubstr("it sweeps trough.restitution"));
    }
    EXPECT_THROW(contrast_rows_against(made.compared, "nothing"), core::InputError);
}

}  // namespace
}  // namespace vibrotrough::compare
