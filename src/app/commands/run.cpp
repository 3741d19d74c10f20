#include "app/campaign_run.hpp"
#include "app/commands/command.hpp"
#include "app/extra_lines.hpp"
#include "app/progress_log.hpp"
#include "campaign/execute/campaign_driver.hpp"
#include "campaign/schedule/policy.hpp"
#include "campaign/state/overview.hpp"

namespace vibrotrough::app {
namespace {

struct RunArguments {
    RunOptions shared;
    bool wait = false;
};

int exit_code_of(campaign::Summary const& summary) {
    if (summary.interrupted) return interrupted;
    return summary.failed + summary.unsure > 0 ? some_cases_failed : all_well;
}

std::string describe(campaign::Summary const& summary, std::size_t cases, bool runs_on) {
    std::size_t const left =
        cases - static_cast<std::size_t>(summary.finished + summary.unsure + summary.failed);
    std::string text = fmt::format("{} of {} cases finished", summary.finished, cases);
    if (summary.unsure > 0) text += fmt::format(", {} not steady or not precise", summary.unsure);
    if (summary.failed > 0) text += fmt::format(", {} failed", summary.failed);
    if (left > 0 && !runs_on) text += fmt::format(", {} left", left);
    return text + (summary.interrupted ? "; interrupted: the same command continues it" : "");
}

/// Results of an earlier version of the campaign stay on disk but do not belong to this one.
void print_unused_cases(campaign::Plan const& plan) {
    std::size_t const unused = campaign::count_left_aside(plan);
    if (unused > 0)
        fmt::print("{} cases in {} belong to an earlier version of the campaign and are not used\n", unused,
                   (plan.folder / "cases").string());
}

/// What was submitted, for packings that run on after this command has returned.
std::string describe_submission(campaign::Summary const& summary) {
    std::string text;
    if (summary.in_queue > 0)
        text += fmt::format("; {} packings are in Slurm's queue already", summary.in_queue);
    if (summary.submitted > summary.not_taken) {
        text += fmt::format("; {} packings submitted as {}", summary.submitted - summary.not_taken,
                            fmt::join(summary.references, "; "));
        if (summary.again > 0) text += fmt::format(" ({} of them again)", summary.again);
    }
    if (summary.not_taken > 0) {
        text += fmt::format(
            "; Slurm has no room for {} packings now: call the same command again later, or with --wait, "
            "which "
            "submits them as others end",
            summary.not_taken);
    }
    return text;
}

/// Writes the summary of the run to standard output and to the log, and returns the exit code.
int report(campaign::Summary const& summary, campaign::Plan const& plan, campaign::Until until) {
    bool const has_waited = until == campaign::Until::done && !summary.interrupted;
    bool const is_queued = !summary.references.empty() || summary.in_queue > 0 || summary.not_taken > 0;
    bool const runs_on = is_queued && !has_waited;
    std::string const end =
        describe(summary, plan.cases.size(), runs_on) + (runs_on ? describe_submission(summary) : "");
    CampaignLog(plan.folder).info("run ends: " + end);
    fmt::print("{}\n", end);
    print_unused_cases(plan);
    std::string const folder = core::shell_word(plan.folder);
    if (runs_on) {
        fmt::print("follow with: vibrotrough status {}\n", folder);
    } else {
        fmt::print("results in {}; see them with: vibrotrough compare {}\n", plan.folder.string(), folder);
    }
    if (runs_on && !summary.interrupted) return all_well;
    return exit_code_of(summary);
}

int run_run(RunArguments const& options) {
    ReadyCampaign ready = prepare_run(options.shared);
    if (ready.is_interrupted) return interrupted;
    size_tasks(ready, ready.campaign.run.batch(ready.campaign.run.executor).minutes_per_task);
    auto const until = options.wait ? campaign::Until::done : campaign::Until::submitted;
    campaign::Summary const summary =
        drive_campaign(options.shared, ready, *campaign::make_policy(), until, *ready.kind);
    return report(summary, ready.plan, until);
}

}  // namespace

void add_run(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<RunArguments>();
    CLI::App* const command =
        program.add_subcommand("run", "Simulate all cases of a campaign that are not finished yet");
    options->shared.add_to(*command);
    add_templates(*command, options->shared.templates);
    command->add_flag(
        "--wait", options->wait,
        "On a cluster: stay and submit further packings until all cases have ended, instead of returning "
        "after submission");
    command->footer(
        R"(The campaign is checked first (see 'vibrotrough check --help'), and each engine binary is
tested once: impacts of single grains, which show restitution and Coulomb's friction. Each case is then simulated in several packings. Packings, or
cycles of each, are added until the interval of the case's velocity efficiency is as narrow as measure.half_width asks,
or measure.max_packings, measure.max_cycles or measure.max_core_time is reached. What a case that is not precise would
still need is printed when it ends. A summary and the next command are printed at the end.

Ctrl-C stops the run cleanly. The same command continues it; a finished case is never simulated again. A case that
is not precise is continued after measure.max_packings or measure.max_core_time has been raised. In the background of
a script ('run ... &') a shell makes its programs ignore Ctrl-C and SIGINT: stop it there with 'kill PID' (SIGTERM), which
is as clean.

With the executor of a cluster under [run] in the campaign file, the next packings of each case are submitted as job arrays
and the command returns. Call it again when they have ended, until it submits nothing more. With --wait it stays and
submits further packings by itself. It also finds tasks that died and submits them again.

Example:
  vibrotrough run validation/demo/campaign.toml --output runs/demo --jobs 2)");
    command->callback([options, &exit_code] { exit_code = run_run(*options); });
}

}  // namespace vibrotrough::app
