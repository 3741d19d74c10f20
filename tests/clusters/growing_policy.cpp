// A program that runs a campaign with a policy of its own: packings are added to a case while the campaign
// runs, and a case is added when the first one has ended. It shows that both executors serve any policy.
//
//   growing_policy run CAMPAIGN.toml FOLDER        runs the campaign to its end, with the executor it asks
//   for growing_policy work FOLDER --task-list FILE --index N ...   one packing, as a task of the cluster
//   runs it
//   growing_policy stop ...                        the same, but it gets SIGTERM before the engine begins

#include "campaign/execute/campaign_driver.hpp"
#include "campaign/execute/packing_worker.hpp"
#include "campaign/execute/task_list.hpp"
#include "core/error.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>

using namespace vibrotrough;

namespace {

/// One packing more than the campaign file asks for, decided only when those are finished; and one case more,
/// with half the friction of the first, when the first has a result.
class GrowingPolicy : public campaign::Policy {
  public:
    campaign::CaseDecision decide(campaign::KnownCase const& known) const override {
        constexpr int cycles = 20;
        int const asked = known.planned->scenario().measure.packings;
        campaign::CaseDecision decision;
        for (int packing = 1; packing <= asked; ++packing) decision.wanted.push_back({packing, cycles, {}});
        auto const all_done = [&] {
            return std::ranges::all_of(decision.wanted, [&](deck::PackingPlan const& packing) {
                return campaign::is_done(known, packing);
            });
        };
        if (all_done()) decision.wanted.push_back({asked + 1, cycles, {}});
        if (!all_done()) return decision;
        for (deck::PackingPlan const& packing : decision.wanted) decision.result.push_back(packing.number);
        decision.cycles = cycles;
        return decision;
    }

    std::vector<scenario::Scenario> further_cases(
        std::vector<campaign::KnownCase const*> const& known) const override {
        campaign::KnownCase const& first = *known.front();
        if (!first.result) return {};
        scenario::Scenario added = first.planned->scenario();
        added.trough.friction /= 2;
        return {added};
    }
};

/// The same, but the process is asked to stop while it decides: before the engine of a packing has begun.
class StoppingPolicy : public GrowingPolicy {
  public:
    campaign::CaseDecision decide(campaign::KnownCase const& known) const override {
        std::raise(SIGTERM);
        return GrowingPolicy::decide(known);
    }
};

class Silent : public campaign::Observer {
  public:
    void progressed(campaign::Progress const&) override {}
    void case_ended(campaign::PlannedCase const& planned, core::Outcome outcome,
                    std::string const&) override {
        fmt::print("{} {}\n", planned.id, name_of(outcome));
        std::fflush(stdout);
    }
};

int run(std::filesystem::path const& file, std::filesystem::path const& folder) {
    scenario::Campaign const campaign = scenario::read_campaign(file);
    engine::Engine const engine = engine::find_engine({});
    campaign::Plan plan = campaign::make_plan(campaign, folder, engine.version);
    Silent observer;
    campaign::Summary const summary = campaign::run_campaign(
        plan, file, GrowingPolicy(), campaign::executor_kind(campaign.run.executor),
        {folder, engine, campaign.run, 2, std::filesystem::read_symlink("/proc/self/exe")},
        campaign::Until::done, observer);
    fmt::print("{} cases, {} finished, {} failed\n", plan.cases.size(), summary.finished + summary.unsure,
               summary.failed);
    return summary.interrupted ? 130 : 0;
}

/// work FOLDER --task-list FILE --index N --ranks R --retries N [--time-limit S], as the job script calls it.
int work(int argc, char** argv) {
    std::string list, index;
    for (int i = 3; i + 1 < argc; ++i) {
        if (std::string_view(argv[i]) == "--task-list") list = argv[i + 1];
        if (std::string_view(argv[i]) == "--index") index = argv[i + 1];
    }
    campaign::PackingId const packing = campaign::read_task(list, std::stoi(index)).at(0);
    bool const stops = std::string_view(argv[1]) == "stop";
    auto const result = stops ? campaign::work(argv[2], packing, {}, StoppingPolicy())
                              : campaign::work(argv[2], packing, {}, GrowingPolicy());
    fmt::print("{}\n", result.message);
    return result.kind == campaign::WorkResult::interrupted ? 130 : 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        if (argc == 4 && std::string_view(argv[1]) == "run") return run(argv[2], argv[3]);
        if (argc > 3 && (std::string_view(argv[1]) == "work" || std::string_view(argv[1]) == "stop"))
            return work(argc, argv);
        return 2;
    } catch (std::exception const& error) {
        fmt::print(stderr, "growing_policy: {}\n", error.what());
        return 1;
    }
}
