#include "app/commands.hpp"
#include "app/commands/common_options.hpp"
#include "app/engine_certificate.hpp"
#include "app/exit_code.hpp"
#include "app/progress_log.hpp"
#include "app/progress_printer.hpp"
#include "app/standard_streams.hpp"
#include "campaign/execute/campaign_driver.hpp"
#include "campaign/schedule/policy.hpp"
#include "campaign/state/folder_lock.hpp"
#include "campaign/state/overview.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/shell.hpp"
#include "deck/campaign_check.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::app {
namespace {

namespace fs = std::filesystem;

struct Options {
    std::string campaign_file;
    std::string output;
    std::string engine;
    std::string progress = "text";
    bool quiet = false;
    bool accept_failed_probes = false;
    bool accept_findings = false;
    bool wait = false;
    int jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
};

int exit_code_of(campaign::Summary const& summary) {
    if (summary.interrupted) return interrupted;
    return summary.failed + summary.unsure > 0 ? some_cases_failed : all_well;
}

std::unique_ptr<campaign::Observer> make_observer(Options const& options) {
    if (options.quiet || options.progress == "none") return std::make_unique<NoProgress>();
    if (options.progress == "json") return std::make_unique<JsonProgress>();
    return std::make_unique<ProgressPrinter>();
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
std::string describe_submission(campaign::Summary const& summary, std::string_view executor) {
    std::string text;
    if (summary.in_queue > 0)
        text += fmt::format("; {} packings are in {}'s queue already", summary.in_queue, executor);
    if (summary.submitted > 0) {
        text += fmt::format("; {} packings submitted as {}", summary.submitted,
                            fmt::join(summary.references, "; "));
        if (summary.again > 0) text += fmt::format(" ({} of them again)", summary.again);
    }
    return text;
}

/// Prints what is not fine on standard error, one line each.
void print_findings(deck::CampaignCheck const& found, std::string const& campaign_file) {
    int const count = found.warnings() + found.errors();
    if (count == 0) return;
    tell("check: {} finding{} ('vibrotrough check {}' shows all):\n", count, count == 1 ? "" : "s",
         campaign_file);
    for (deck::CheckedItem const& item : found.items) {
        if (item.worst.severity == deck::Severity::fine) continue;
        tell("  {}: {}\n", to_string(item.worst.severity), describe(item, found.cases));
    }
}

/// Checks the campaign and prints what is not fine. @throws InputError when there are errors that the user
/// has not accepted
void check(Options const& options, scenario::Campaign const& campaign) {
    deck::CampaignCheck const found = deck::check_campaign(campaign);
    print_findings(found, options.campaign_file);
    if (found.errors() == 0 || options.accept_findings) return;
    throw core::InputError(
        fmt::format("{}: {}; correct it (see 'vibrotrough check'), or run it anyway with --accept-findings",
                    options.campaign_file, found.first_error()));
}

/// Writes the summary of the run to standard output and to the log, and returns the exit code.
int report(campaign::Summary const& summary, campaign::Plan const& plan, campaign::ExecutorKind const& kind) {
    bool const runs_on = !summary.references.empty() || summary.in_queue > 0;
    std::string const end = describe(summary, plan.cases.size(), runs_on) +
                            (runs_on ? describe_submission(summary, kind.title) : "");
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

int run(Options const& options) {
    scenario::Campaign const campaign = scenario::read_campaign(options.campaign_file);
    std::optional<fs::path> const program =
        options.engine.empty() ? std::nullopt : std::optional<fs::path>(options.engine);
    engine::Engine engine = engine::find_engine(program);
    fs::path const folder =
        options.output.empty() ? fs::path("runs") / campaign.name : fs::path(options.output);
    core::make_folder(folder);
    core::OwnFolder const own(folder);
    {
        // Fail now, before anything else is done, if the disk is full or another driver works in the folder.
        campaign::FolderLock const lock(folder);
    }
    check(options, campaign);
    if (!certify(engine, options.accept_failed_probes)) return interrupted;
    campaign::Plan plan = campaign::make_plan(campaign, folder, engine.version);
    campaign::ExecutorKind const& kind = campaign::executor_kind(campaign.run.executor);
    campaign::ExecutorInputs const inputs{folder, engine, campaign.run, options.jobs,
                                          fs::read_symlink("/proc/self/exe")};
    auto const until = options.wait ? campaign::Until::done : campaign::Until::submitted;
    campaign::Summary summary;
    {
        auto const shown = make_observer(options);
        LoggingObserver observer(*shown, folder);
        summary = campaign::run_campaign(plan, options.campaign_file, *campaign::make_policy(), kind, inputs,
                                         until, observer);
    }
    campaign::write_campaign_file(plan);
    return report(summary, plan, kind);
}

}  // namespace

void add_run(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<Options>();
    CLI::App* const command =
        program.add_subcommand("run", "Simulate all cases of a campaign that are not finished yet");
    add_campaign_file(*command, options->campaign_file);
    add_results_folder(*command, options->output);
    command
        ->add_option(
            "--jobs", options->jobs,
            "Number of cores to use. Each engine takes one core, or several when it has several MPI ranks")
        ->check(CLI::Range(1, 4096))
        ->capture_default_str();
    add_engine(*command, options->engine);
    command->add_option("--progress", options->progress, "How to show progress on standard error")
        ->check(CLI::IsMember({"text", "json", "none"}))
        ->capture_default_str();
    command->add_flag("--quiet", options->quiet, "Show no progress; the same as --progress none");
    command->add_flag("--accept-failed-probes", options->accept_failed_probes, accept_failed_probes_help);
    command->add_flag("--accept-findings", options->accept_findings,
                      "Run although the check of the campaign found errors (see 'vibrotrough check')");
    command->add_flag(
        "--wait", options->wait,
        "On a cluster: stay and submit further packings until all cases have ended, instead of returning "
        "after submission");
    command->footer(
        R"(The campaign is checked first (see 'vibrotrough check --help'), and each engine binary is
tested once (see 'vibrotrough probe-engine --help'). Each case is then simulated in several packings. Packings, or
cycles of each, are added until the interval of the case's velocity efficiency is as narrow as measure.half_width asks,
or measure.max_packings, measure.max_cycles or measure.max_core_time is reached. What a case that is not precise would
still need is printed when it ends. A summary and the next command are printed at the end.

Ctrl-C stops the run cleanly. The same command continues it; a finished case is never simulated again. A case that
is not precise is continued after measure.max_packings or measure.max_core_time has been raised.

With executor = "slurm" under [run] in the campaign file, the next packings of each case are submitted as job arrays
and the command returns. Call it again when they have ended, until it submits nothing more. With --wait it stays and
submits further packings by itself. It also finds tasks that died and submits them again.

Exit codes:
    0  all cases are finished
    1  some cases failed, or are not precise, not steady, or bistable or slow
    2  the input is wrong
    3  something is missing: no liggghts, one that failed its probes, or no disk space
  130  interrupted

Example:
  vibrotrough run validation/demo/campaign.toml --output runs/demo --jobs 2)");
    command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vibrotrough::app
