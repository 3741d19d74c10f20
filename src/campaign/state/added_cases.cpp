#include "campaign/state/added_cases.hpp"

#include "campaign/state/campaign_folder.hpp"
#include "core/error.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> entries(fs::path const& folder) {
    std::vector<fs::path> found;
    std::error_code missing;
    for (auto const& entry : fs::directory_iterator(folder / "added", missing)) {
        if (fs::is_regular_file(entry.path() / "scenario.toml", missing)) found.push_back(entry.path());
    }
    std::ranges::sort(found);
    return found;
}

}  // namespace

std::vector<scenario::Scenario> read_added_cases(fs::path const& folder) {
    std::vector<scenario::Scenario> added;
    for (fs::path const& entry : entries(folder)) {
        try {
            auto cases = scenario::read_campaign(entry / "scenario.toml").cases;
            if (cases.size() == 1) added.push_back(std::move(cases.front()));
        } catch (core::Error const&) {
            // Damaged; the policy will ask for the case again.
        }
    }
    return added;
}

PlannedCase const* add_case(Plan& plan, scenario::Scenario const& scenario) {
    PlannedCase planned = plan_case(scenario, plan.folder, plan.engine_version);
    bool const is_known =
        std::ranges::any_of(plan.cases, [&](PlannedCase const& one) { return one.id == planned.id; });
    if (is_known) return nullptr;
    int number = 1;
    while (fs::exists(plan.folder / "added" / fmt::format("{:04}", number))) ++number;
    write_scenario(scenario, plan.folder / "added" / fmt::format("{:04}", number));
    planned.is_added = true;
    plan.cases.push_back(std::move(planned));
    label_cases(plan);
    return &plan.cases.back();
}

}  // namespace vibrotrough::campaign
