#include "campaign/state/plan.hpp"

#include "campaign/state/added_cases.hpp"
#include "core/hash.hpp"
#include "core/parallel.hpp"
#include "deck/render.hpp"
#include "scenario/reader/written_campaign.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;

/// Plans scenarios one after the other; each id once, because two ways to write one case are one case.
void add_cases(std::deque<PlannedCase>& cases, std::set<std::string>& ids,
               std::vector<scenario::Scenario> const& scenarios, fs::path const& folder,
               std::string const& engine_version, bool are_added) {
    std::vector<PlannedCase> found(scenarios.size());
    core::for_each_index(scenarios.size(), cases_per_thread, [&] {
        return [&](std::size_t i) {
            found[i].prepared =
                std::make_shared<prepare::PreparedCase const>(prepare::prepare_case(scenarios[i]));
            found[i].id = case_id(*found[i].prepared, engine_version);
            found[i].folder = folder / "cases" / found[i].id;
            found[i].is_added = are_added;
        };
    });
    for (PlannedCase& one : found)
        if (ids.insert(one.id).second) cases.push_back(std::move(one));
}

}  // namespace

std::string case_id(prepare::PreparedCase const& prepared, std::string const& engine_version) {
    return core::sha256_hex(fmt::format("{}\n{}\n{}", engine_version, deck::digest_of_templates(),
                                        scenario::identity_of(prepared.scenario)))
        .substr(0, 12);
}

Plan make_plan(scenario::Campaign const& campaign, fs::path const& folder,
               std::string const& engine_version) {
    Plan plan{campaign.name, folder, engine_version, {}, campaign.files, campaign.swept};
    std::set<std::string> ids;
    add_cases(plan.cases, ids, campaign.cases, folder, engine_version, false);
    add_cases(plan.cases, ids, read_added_cases(folder), folder, engine_version, true);
    label_cases(plan);
    return plan;
}

void label_cases(Plan& plan) {
    scenario::Key const* const feed = scenario::find_key("feed.mass_flow");
    bool const is_open = !plan.cases.empty() && scenario::is_open(plan.cases.front().scenario());
    if (is_open && std::ranges::find(plan.swept, feed) == plan.swept.end()) {
        bool const differs = std::ranges::any_of(plan.cases, [&](PlannedCase const& one) {
            return one.scenario().feed.mass_flow != plan.cases.front().scenario().feed.mass_flow;
        });
        if (differs) plan.swept.push_back(feed);
    }
    for (PlannedCase& planned : plan.cases) planned.label = swept_label(planned.scenario(), plan.swept);
}

PlannedCase plan_case(scenario::Scenario const& scenario, fs::path const& folder,
                      std::string const& engine_version) {
    std::deque<PlannedCase> cases;
    std::set<std::string> ids;
    add_cases(cases, ids, {scenario}, folder, engine_version, false);
    return cases.front();
}

std::size_t count_left_aside(Plan const& plan) {
    std::set<std::string> ids;
    for (PlannedCase const& planned : plan.cases) ids.insert(planned.id);
    std::size_t count = 0;
    std::error_code ignored;
    for (auto const& entry : fs::directory_iterator(plan.folder / "cases", ignored)) {
        if (!ids.contains(entry.path().filename().string())) ++count;
    }
    return count;
}

}  // namespace vibrotrough::campaign
