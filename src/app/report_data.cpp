#include "app/report_data.hpp"

#include "app/point_mass.hpp"
#include "campaign/state/overview.hpp"
#include "compare/compared_cases.hpp"
#include "compare/exports.hpp"
#include "compare/point_mass_csv.hpp"
#include "core/atomic_file.hpp"
#include "core/time.hpp"
#include "core/version.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::app {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// One period of the point mass; empty when its motion has no period.
std::string point_mass_csv(scenario::Scenario const& scenario) {
    auto const found = point_mass_beside(scenario);
    if (!found) return {};
    return compare::point_mass_csv(
        found->motion,
        {found->length_x, found->length_z, angular_frequency(scenario.trough), found->phase_at_start});
}

/// Makes campaign.h5 anew when a case was finished after it was written: figures can be drawn while cases
/// run.
void renew_campaign_file(campaign::Plan const& plan) {
    std::error_code none;
    fs::file_time_type const written = fs::last_write_time(plan.folder / "campaign.h5", none);
    bool const there = !none;
    for (campaign::PlannedCase const& planned : plan.cases) {
        fs::file_time_type const finished = fs::last_write_time(planned.result_file(), none);
        if (!none && (!there || finished > written)) return campaign::write_campaign_file(plan);
    }
}

}  // namespace

int write_report_data(campaign::Plan const& plan, fs::path const& folder) {
    renew_campaign_file(plan);
    compare::ComparedCases const compared = compare::compared_cases(plan);
    auto const& [cases, rows] = compared;
    core::make_folder(folder / "point_mass");
    for (campaign::CaseOverview const& one : cases) {
        core::write_file_atomically(folder / "point_mass" / (one.planned->id + ".csv"),
                                    point_mass_csv(one.planned->scenario));
    }
    Json const json{{"campaign", plan.name},
                    {"program_version", core::program_version()},
                    {"git_commit", core::program_commit()},
                    {"engine_version", plan.engine_version},
                    {"written", core::utc_now()},
                    {"input", core::read_file(plan.folder / "campaign.toml")},
                    {"columns", compare::column_descriptions()},
                    {"cases", compare::case_list(compared)}};
    constexpr auto replace = Json::error_handler_t::replace;  // what users write need not be UTF-8
    core::write_file_atomically(folder / "campaign.json", json.dump(2, ' ', false, replace) + "\n");
    core::write_file_atomically(folder / "theory_curves.csv", compare::theory_curves_csv(rows));
    return static_cast<int>(
        std::ranges::count_if(cases, [](auto const& one) { return one.record.has_value(); }));
}

}  // namespace vibrotrough::app
