#include "compare/report_data.hpp"

#include "atlas/atlas.hpp"
#include "compare/compared_cases.hpp"
#include "compare/contrasts.hpp"
#include "compare/exports.hpp"
#include "compare/point_mass_csv.hpp"
#include "compare/record_files.hpp"
#include "core/atomic_file.hpp"
#include "core/time.hpp"
#include "core/version.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::compare {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// One period of the point mass; empty when its motion has no period.
std::string period_csv(prepare::PreparedCase const& prepared) {
    auto const point_mass = point_mass_motion(prepared);
    return point_mass ? point_mass_csv(*point_mass) : "";
}

/// The swept keys with their columns. `path` is the dataset of campaign.h5 below swept/.
Json swept_list(campaign::Plan const& plan) {
    Json list = Json::array();
    auto const columns = columns_with_swept(plan.swept);
    for (scenario::Key const* const key : plan.swept) {
        auto const column = std::ranges::find(columns, key->path, &Column::key);
        list.push_back({{"key", key->path},
                        {"name", scenario::short_name(*key)},
                        {"column", column->name},
                        {"unit", scenario::shown_unit(*key).name},
                        {"meaning", key->meaning}});
    }
    return list;
}

/// A number of the atlas with its interval.
Json with_interval(std::optional<atlas::SurfaceValue> const& value) {
    if (!value) return nullptr;
    return {{"value", value->efficiency}, {"half_width", value->half_width}};
}

/// The rows of compare, with what depth and slope change where the atlas knows it.
Json cases_with_effects(ComparedCases const& compared) {
    Json list = case_list(compared);
    for (std::size_t i = 0; i < compared.cases.size(); ++i) {
        auto const effects = atlas::effects(*compared.cases[i].planned->prepared);
        if (!effects) continue;
        list.at(i)["atlas_effects"] = {{"depth", effects->depth},
                                       {"of_depth", with_interval(effects->of_depth)},
                                       {"of_slope", with_interval(effects->of_slope)}};
    }
    return list;
}

/// The differences of a campaign that sweeps exactly one key; null of any other, because there are many ways
/// to compare its cases.
Json differences(campaign::Plan const& plan, ComparedCases const& compared) {
    if (plan.swept.size() != 1) return nullptr;
    std::string_view const key = plan.swept.front()->path;
    auto const columns = contrast_columns(compared.columns, plan.swept);
    Json rows = Json::array();
    for (Row const& row : contrast_rows_of(plan, compared, key)) {
        Json one = to_object(row, columns);
        for (campaign::CaseOverview const& overview : compared.cases) {
            if (overview.planned->id == row.id) one["label"] = overview.planned->label;
            if (Json(overview.planned->id) == one["against"]) one["against_label"] = overview.planned->label;
        }
        rows.push_back(std::move(one));
    }
    return {{"key", key}, {"rows", std::move(rows)}};
}

}  // namespace

std::vector<campaign::CaseOverview> write_report_data(campaign::Plan const& plan,
                                                      campaign::Activity const& activity,
                                                      fs::path const& folder) {
    ComparedCases compared = compared_cases(plan, activity);
    auto const& cases = compared.cases;
    core::make_folder(folder / "point_mass");
    for (campaign::CaseOverview const& one : cases) {
        core::write_file_atomically(folder / "point_mass" / (one.planned->id + ".csv"),
                                    period_csv(*one.planned->prepared));
    }
    Json const json{{"campaign", plan.name},
                    {"program_version", core::program_version()},
                    {"git_commit", core::program_commit()},
                    {"engine_version", plan.engine_version},
                    {"written", core::utc_now()},
                    {"input", core::read_file(plan.folder / "campaign.toml", core::largest_note)},
                    {"columns", column_descriptions(compared.columns)},
                    {"swept", swept_list(plan)},
                    {"cases", cases_with_effects(compared)},
                    {"differences", differences(plan, compared)},
                    {"records", write_records(cases, folder)}};
    constexpr auto replace = Json::error_handler_t::replace;  // a user's text may not be UTF-8
    core::write_file_atomically(folder / "campaign.json", json.dump(2, ' ', false, replace) + "\n");
    core::write_file_atomically(folder / "theory_curves.csv", theory_curves_csv(compared.rows));
    return std::move(compared.cases);
}

}  // namespace vibrotrough::compare
