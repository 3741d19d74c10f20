#include "app/check_report.hpp"
#include "app/commands.hpp"
#include "app/engine_certificate.hpp"
#include "app/exit_code.hpp"
#include "app/progress_log.hpp"
#include "app/progress_printer.hpp"
#include "campaign/execute/campaign_driver.hpp"
#include "campaign/schedule/policy.hpp"
#include "campaign/state/folder_lock.hpp"
#include "campaign/state/overview.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/shell.hpp"

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

std::string describe(campaign::Summary const& summary, std::size_t cases, bool goes_on) {
    std::size_t const left =
        cases - static_cast<std::size_t>(summary.finished + summary.unsure + summary.failed);
    std::string text = fmt::format("{} of {} cases finished", summary.finished, cases);
    if (summary.unsure > 0) text += fmt::format(", {} not steady or not precise", summary.unsure);
    if (summary.failed > 0) text += fmt::format(", {} failed", summary.failed);
    if (left > 0 && !goes_on) text += fmt::format(", {} left", left);
    return text + (summary.interrupted ? "; interrupted: the same command goes on where it stopped" : "");
}

/// Results of an earlier version of the campaign stay on disk and are no part of this one.
void say_what_is_left_aside(campaign::Plan const& plan) {
    std::size_t const aside = campaign::count_left_aside(plan);
    if (aside > 0)
        fmt::print("{} cases in {} are of an earlier version of the campaign and left aside\n", aside,
                   (plan.folder / "cases").string());
}

/// What the executor was given, for packings that go on when this command has returned.
std::string describe_submission(campaign::Summary const& summary, std::string_view executor) {
    std::string text;
    if (summary.in_queue > 0)
        text += fmt::format("; {} packings are in {}'s queue already", summary.in_queue, executor);
    if (summary.submitted > 0) {
        text += fmt::format("; {} packings submitted as {}", summary.submitted,
                            fmt::join(summary.references, "; "));
        if (summary.again > 0) text += fmt::format(" ({} of them once more)", summary.again);
    }
    return text;
}

/// Shows what the check warns of. Errors refuse the campaign unless the user accepts them.
void check(Options const& options, scenario::Campaign const& campaign) {
    CheckReport const report = check_campaign(campaign);
    print_warnings(report, options.campaign_file);
    if (report.errors() == 0 || options.accept_findings) return;
    throw core::InputError(
        fmt::format("{}: {}; mend it, see 'vibrotrough check', or run all the same with --accept-findings",
                    options.campaign_file, report.first_error()));
}

/// Says what the run came to, on standard output and in the log, and gives the exit code.
int report(campaign::Summary const& summary, campaign::Plan const& plan, campaign::ExecutorKind const& kind) {
    bool const goes_on = !summary.references.empty() || summary.in_queue > 0;
    std::string const end = describe(summary, plan.cases.size(), goes_on) +
                            (goes_on ? describe_submission(summary, kind.title) : "");
    CampaignLog(plan.folder).info("run ends: " + end);
    fmt::print("{}\n", end);
    say_what_is_left_aside(plan);
    std::string const folder = core::shell_word(plan.folder);
    if (goes_on) {
        fmt::print("follow with: vibrotrough status {}\n", folder);
    } else {
        fmt::print("results in {}; see them with: vibrotrough compare {}\n", plan.folder.string(), folder);
    }
    if (goes_on && !summary.interrupted) return all_well;
    return exit_code_of(summary);
}

int run(Options const& options) {
    scenario::Campaign const campaign = scenario::read_campaign(options.campaign_file);
    std::optional<fs::path> const asked =
        options.engine.empty() ? std::nullopt : std::optional<fs::path>(options.engine);
    engine::Engine engine = engine::find_engine(asked);
    fs::path const folder =
        options.output.empty() ? fs::path("runs") / campaign.name : fs::path(options.output);
    core::make_folder(folder);
    {
        // That there is no place, or another driver, is known before anything else is done.
        campaign::FolderLock const free_for_us(folder);
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
        program.add_subcommand("run", "Run every case of a campaign that is not finished");
    command
        ->add_option("CAMPAIGN.toml", options->campaign_file,
                     "The campaign file (its keys: vibrotrough keys)")
        ->required();
    command->add_option("--output", options->output, "Folder of the campaign's results; default runs/<name>")
        ->type_name("DIR");
    command
        ->add_option("--jobs", options->jobs,
                     "Cores to use: so many engines at a time, fewer when they have several MPI ranks")
        ->check(CLI::Range(1, 4096))
        ->capture_default_str();
    command->add_option("--liggghts", options->engine, "The LIGGGHTS program; default: liggghts on the PATH")
        ->type_name("PATH");
    command->add_option("--progress", options->progress, "How to show progress on standard error")
        ->check(CLI::IsMember({"text", "json", "none"}))
        ->capture_default_str();
    command->add_flag("--quiet", options->quiet, "Show no progress; the same as --progress none");
    command->add_flag("--accept-failed-probes", options->accept_failed_probes,
                      "Run although the engine failed its probes (see probe-engine)");
    command->add_flag("--accept-findings", options->accept_findings,
                      "Run although the check of the campaign found errors (see check)");
    command->add_flag("--wait", options->wait,
                      "Stay until all packings have ended also where a cluster runs them");
    command->footer(
        "The campaign is checked first, see 'vibrotrough check --help'. The engine is probed once per "
        "binary, see\n'vibrotrough probe-engine --help'.\n"
        "Ctrl-C stops cleanly, and the same command goes on where it stopped: a finished case is never run "
        "again.\n"
        "Exit codes: 0 all cases finished; 1 some failed, or were not steady or not precise; 2 the input is "
        "wrong;\n"
        "3 something is missing (no liggghts, one that failed its probes, no disk);\n130 interrupted.\n"
        "With executor = \"slurm\" under [run] the packings are submitted as job arrays and the command "
        "returns,\n"
        "unless --wait is given; the same command finds the tasks that died and submits them again.\n"
        "Example: vibrotrough run validation/demo/campaign.toml --output runs/demo --jobs 2");
    command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vibrotrough::app
