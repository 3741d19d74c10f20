#include "app/campaign_run.hpp"
#include "app/commands/command.hpp"
#include "campaign/execute/executors.hpp"
#include "campaign/schedule/forecast.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "campaign/state/case_state.hpp"
#include "campaign/state/overview.hpp"
#include "compare/compared_cases.hpp"
#include "compare/exports.hpp"
#include "core/text.hpp"

namespace vibrotrough::app {
namespace {

struct StatusArguments {
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

/// What is known of a campaign: its cases and what they will still cost.
struct StatusView {
    campaign::Plan const& plan;
    std::vector<campaign::CaseOverview> const& cases;
    campaign::Forecast const& cost;
};

/// Cycles by packing of those that are being simulated; none of a case that nobody works on.
std::map<int, int> cycles_under_way(campaign::CaseOverview const& one) {
    if (one.status != campaign::CaseStatus::running) return {};
    return campaign::cycles_under_way(*one.planned);
}

void print_json(StatusView const& view) {
    Counts const counts = count(view.cases);
    auto const columns = compare::columns_with_swept(view.plan.swept);
    auto const describe_case = [&](std::size_t i) {
        campaign::CaseOverview const& one = view.cases[i];
        Json running = Json::array();
        for (auto const& [packing, cycles] : cycles_under_way(one))
            running.push_back({{"packing", packing}, {"cycles", cycles}});
        Json object{{"case", one.planned->id},
                    {"label", one.planned->label},
                    {"outcome", one.label()},
                    {"message", one.message},
                    {"packings_done", one.packings_done},
                    {"packings", one.planned->scenario().measure.packings},
                    {"running", running},
                    {"core_time_to_go_s", view.cost.cases[i]}};
        object.update(compare::swept_object(compare::planned_row(view.plan, one), columns));
        return object;
    };
    Json head{{"campaign", view.plan.name},
              {"engine", view.plan.engine_version},
              {"cases_total", view.cases.size()},
              {"finished", counts.finished},
              {"unsure", counts.unsure},
              {"failed", counts.failed},
              {"running", counts.running},
              {"left", counts.left},
              {"core_time_to_go_s", view.cost.core_time},
              {"core_time_uncertainty_factor", view.cost.uncertainty}};
    head["cases"] = Json::array();
    print_with_list(head, view.cases.size(), describe_case);
}

/// "; packing 2: 21 cycles; about 0.02 core-hours to go"
std::string describe_progress(campaign::CaseOverview const& one, double core_time) {
    std::string text;
    for (auto const& [packing, cycles] : cycles_under_way(one))
        text += fmt::format("; packing {}: {} cycles", packing, cycles);
    bool const goes_on =
        one.status != campaign::CaseStatus::ended && one.status != campaign::CaseStatus::failed;
    if (goes_on && core_time > 0) text += fmt::format("; about {:.2g} core-hours to go", core_time / 3600);
    return text;
}

void print_text(StatusView const& view) {
    Counts const counts = count(view.cases);
    std::size_t widest = 0;
    for (campaign::CaseOverview const& one : view.cases) widest = std::max(widest, one.planned->label.size());
    for (std::size_t i = 0; i < view.cases.size(); ++i) {
        campaign::CaseOverview const& one = view.cases[i];
        if (one.status == campaign::CaseStatus::open) continue;
        bool const has_ended = one.status == campaign::CaseStatus::ended;
        std::string const least =
            has_ended ? "" : fmt::format(" of at least {}", one.planned->scenario().measure.packings);
        std::string const label = widest == 0 ? "" : fmt::format("  {:<{}}", one.planned->label, widest);
        fmt::print("{}{}  {:<16} packings {}{}{}{}{}\n", one.planned->id, label, one.label(),
                   one.packings_done, least, describe_progress(one, view.cost.cases[i]),
                   one.message.empty() ? "" : "  ", core::harmless(one.message));
    }
    fmt::print(
        "campaign {}: {} case{}; {} finished, {} not steady or not precise, {} failed, {} running, {} left\n",
        view.plan.name, view.cases.size(), view.cases.size() == 1 ? "" : "s", counts.finished, counts.unsure,
        counts.failed, counts.running, counts.left);
    if (counts.running + counts.left == 0 || view.cost.core_time <= 0) return;
    fmt::print("about {:.3g} core-hours to go (probably {:.2g} to {:.2g})\n", view.cost.core_time / 3600,
               view.cost.core_time / view.cost.uncertainty / 3600,
               view.cost.core_time * view.cost.uncertainty / 3600);
}

int run_status(StatusArguments const& options) {
    campaign::Plan const plan = campaign::open_plan(options.folder);
    auto const cases = campaign::survey(plan, campaign::activity_in(plan.folder), {}, campaign::Trust::stamp);
    campaign::Forecast const cost = campaign::forecast(cases);
    StatusView const view{plan, cases, cost};
    options.json ? print_json(view) : print_text(view);
    tell_left_aside(plan, cases);
    return all_well;
}

}  // namespace

void add_status(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<StatusArguments>();
    CLI::App* const command = program.add_subcommand(
        "status", "Show which cases of a campaign are finished, running, failed or still to do");
    add_campaign_folder(*command, options->folder);
    command->add_flag("--json", options->json, "Print JSON for scripts");
    command->footer(
        R"(Prints one line for each case that has started: its id, the values of the swept keys, its state, how
many of its packings have ended, how far the running ones are, the core time that the
case still needs as it is estimated from the finished ones, and why it failed or waits. Of a case that is not precise it says how many packings and core-hours it would still
need, and of one that is bistable or slow the velocity efficiency of both branches. The last line counts the cases. The
command works while the campaign runs, and it changes nothing.

In the JSON, "unsure" is the number of cases that are not precise, not steady, or bistable or slow, and "packings" the
least number of packings of a case.

Example:
  vibrotrough status runs/demo)");
    command->callback([options, &exit_code] { exit_code = run_status(*options); });
}

}  // namespace vibrotrough::app
