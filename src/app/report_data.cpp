#include "app/report_data.hpp"

#include "app/compared_cases.hpp"
#include "app/point_mass.hpp"
#include "campaign/state/overview.hpp"
#include "compare/comparison.hpp"
#include "core/atomic_file.hpp"
#include "core/time.hpp"
#include "core/version.hpp"
#include "theory/quantities.hpp"

#include <algorithm>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::app {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// One period of the point mass; none when its motion has no period.
std::string point_mass_csv(prepare::PreparedCase const& prepared) {
    auto const found = point_mass_beside(prepared);
    if (!found) return {};
    auto const& [motion, along, normal, phase_at_start] = *found;
    double const omega = prepared.angular_frequency;
    constexpr int per_cycle = 360;
    std::string text =
        "cycles,phase,gap_m,relative_displacement_m,velocity_x_m_per_s,velocity_z_m_per_s,"
        "relative_velocity_x_m_per_s,relative_velocity_z_m_per_s,normal_force_n_per_kg,tangential_force_n_"
        "per_kg\n";
    double const start = theory::sample(motion, phase_at_start).displacement;
    for (int i = 0; i <= per_cycle * motion.motion.period_cycles; ++i) {
        double const cycles = static_cast<double>(i) / per_cycle;
        theory::TraceSample const s =
            theory::sample(motion, phase_at_start + 2.0 * std::numbers::pi * cycles);
        text +=
            fmt::format("{:.6g},{},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g}\n", cycles,
                        theory::to_string(s.kind), normal * s.gap, along * (s.displacement - start),
                        omega * along * s.mass_vx, omega * normal * s.mass_vy,
                        omega * along * (s.mass_vx - s.trough_vx), omega * normal * (s.mass_vy - s.trough_vy),
                        omega * omega * normal * s.normal_force, omega * omega * along * s.tangential_force);
    }
    return text;
}

/// The rows as compare gives them, each with what status knows.
Json case_list(std::vector<campaign::CaseOverview> const& cases, std::vector<compare::Row> const& rows) {
    Json list = Json::parse(compare::to_json(rows));
    for (std::size_t i = 0; i < cases.size(); ++i) {
        list[i]["message"] = cases[i].message;
        list[i]["packings_done"] = cases[i].packings_done;
        list[i]["packings_wanted"] = cases[i].planned->scenario().measure.packings;
    }
    return list;
}

}  // namespace

int write_report_data(campaign::Plan const& plan, fs::path const& folder) {
    if (campaign::is_campaign_file_outdated(plan)) campaign::write_campaign_file(plan);
    auto const [cases, rows] = compared_cases(plan);
    core::make_folder(folder / "point_mass");
    for (campaign::CaseOverview const& one : cases) {
        core::write_file_atomically(folder / "point_mass" / (one.planned->id + ".csv"),
                                    point_mass_csv(*one.planned->prepared));
    }
    Json const json{{"campaign", plan.name},
                    {"program_version", core::program_version()},
                    {"git_commit", core::program_commit()},
                    {"engine_version", plan.engine_version},
                    {"written", core::utc_now()},
                    {"input", core::read_file(plan.folder / "campaign.toml")},
                    {"cases", case_list(cases, rows)}};
    constexpr auto replace = Json::error_handler_t::replace;  // what users write need not be UTF-8
    core::write_file_atomically(folder / "campaign.json", json.dump(2, ' ', false, replace) + "\n");
    core::write_file_atomically(folder / "theory_curves.csv", compare::theory_curves_csv(rows));
    return static_cast<int>(
        std::ranges::count_if(cases, [](auto const& one) { return one.record.has_value(); }));
}

}  // namespace vibrotrough::app
