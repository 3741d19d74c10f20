#include "app/commands.hpp"
#include "app/commands/common_options.hpp"
#include "app/exit_code.hpp"
#include "campaign/execute/executors.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "campaign/state/overview.hpp"
#include "core/text.hpp"

#include <algorithm>
#include <map>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::app {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
    std::string folder;
    bool json = false;
};

/// Number of cases by state. `unsure` counts those with a result and another outcome than finished.
struct Counts {
    int finished = 0, unsure = 0, failed = 0, running = 0, left = 0;
};

Counts count(std::vector<campaign::CaseOverview> const& cases) {
    Counts counts;
    for (campaign::CaseOverview const& one : cases) {
        switch (one.status) {
            case campaign::CaseStatus::ended:
                ++(one.outcome == core::Outcome::finished ? counts.finished : counts.unsure);
                break;
            case campaign::CaseStatus::running:
                ++counts.running;
                break;
            case campaign::CaseStatus::failed:
                ++counts.failed;
                break;
            default:
                ++counts.left;
        }
    }
    return counts;
}

void print_json(campaign::Plan const& plan, std::vector<campaign::CaseOverview> const& cases) {
    Counts const counts = count(cases);
    Json list = Json::array();
    for (campaign::CaseOverview const& one : cases) {
        list.push_back({{"case", one.planned->id},
                        {"outcome", one.label()},
                        {"message", one.message},
                        {"packings_done", one.packings_done},
                        {"packings", one.planned->scenario().measure.packings}});
    }
    Json const json{
        {"campaign", plan.name},       {"engine", plan.engine_version}, {"cases_total", cases.size()},
        {"finished", counts.finished}, {"unsure", counts.unsure},       {"failed", counts.failed},
        {"running", counts.running},   {"left", counts.left},           {"cases", list}};
    fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
}

void print_text(campaign::Plan const& plan, std::vector<campaign::CaseOverview> const& cases) {
    Counts const counts = count(cases);
    for (campaign::CaseOverview const& one : cases) {
        if (one.status == campaign::CaseStatus::open) continue;
        bool const has_ended = one.status == campaign::CaseStatus::ended;
        std::string const least =
            has_ended ? "" : fmt::format(" of at least {}", one.planned->scenario().measure.packings);
        fmt::print("{}  {:<16} packings {}{}{}{}\n", one.planned->id, one.label(), one.packings_done, least,
                   one.message.empty() ? "" : "  ", core::harmless(one.message));
    }
    fmt::print(
        "campaign {}: {} cases; {} finished, {} not steady or not precise, {} failed, {} running, {} left\n",
        plan.name, cases.size(), counts.finished, counts.unsure, counts.failed, counts.running, counts.left);
}

int run(Options const& options) {
    campaign::Plan const plan = campaign::open_plan(options.folder);
    auto const cases = campaign::survey(plan, campaign::activity_in(plan.folder));
    options.json ? print_json(plan, cases) : print_text(plan, cases);
    return all_well;
}

}  // namespace

void add_status(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<Options>();
    CLI::App* const command = program.add_subcommand(
        "status", "Show which cases of a campaign are finished, running, failed or still to do");
    add_campaign_folder(*command, options->folder);
    command->add_flag("--json", options->json, "Print JSON for scripts");
    command->footer(
        R"(Prints one line for each case that has started: its id, its state, how many of its packings have
ended, and why it failed or waits. Of a case that is not precise it says how many packings and core-hours it would still
need, and of one that is bistable or slow the velocity efficiency of both branches. The last line counts the cases. The
command works while the campaign runs, and it changes nothing.

In the JSON, "unsure" is the number of cases that are not precise, not steady, or bistable or slow, and "packings" the
least number of packings of a case.

Example:
  vibrotrough status runs/demo)");
    command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vibrotrough::app
