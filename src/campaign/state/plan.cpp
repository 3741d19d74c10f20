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

using Scenarios = std::vector<scenario::Scenario>;

/// A case before it has a folder.
struct IdentifiedCase {
    std::shared_ptr<prepare::PreparedCase const> prepared = {};
    std::string id = {};
};

/// Prepares cases and finds their ids.
std::vector<IdentifiedCase> identify(Scenarios const& scenarios, std::string const& engine_version) {
    std::vector<IdentifiedCase> cases(scenarios.size());
    core::for_each_index(scenarios.size(), cases_per_thread, [&] {
        return [&, preparer = std::make_shared<prepare::CasePreparer>()](std::size_t i) {
            cases[i].prepared =
                std::make_shared<prepare::PreparedCase const>(preparer->prepare(scenarios[i]));
            cases[i].id = case_id(*cases[i].prepared, engine_version);
        };
    });
    return cases;
}

/// Plans scenarios one after the other; each id once, because two ways to write one case are one case.
class Planner {
  public:
    void add(Scenarios const& scenarios, std::string const& engine_version, bool is_added = false) {
        for (auto& [prepared, id] : identify(scenarios, engine_version)) {
            if (ids_.insert(id).second) cases_.push_back({id, std::move(prepared), {}, {}, is_added});
        }
    }

    /// The cases with their folders.
    std::deque<PlannedCase> place(fs::path const& folder) {
        for (PlannedCase& planned : cases_) planned.folder = folder / "cases" / planned.id;
        return std::move(cases_);
    }

  private:
    std::set<std::string> ids_;
    std::deque<PlannedCase> cases_;
};

}  // namespace

std::string case_id(prepare::PreparedCase const& prepared, std::string const& engine_version) {
    return core::sha256_hex(fmt::format("{}\n{}\n{}", engine_version, deck::digest_of_templates(),
                                        scenario::identity_of(prepared.scenario)))
        .substr(0, 12);
}

Plan make_plan(scenario::Campaign const& campaign, fs::path const& folder,
               std::string const& engine_version) {
    Planner planner;
    planner.add(campaign.cases, engine_version);
    planner.add(read_added_cases(folder), engine_version, true);
    Plan plan{campaign.name, folder, engine_version, planner.place(folder), campaign.files, campaign.swept};
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
    Planner planner;
    planner.add(Scenarios{scenario}, engine_version);
    return planner.place(folder).front();
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
