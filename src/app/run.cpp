#include "app/check_report.hpp"
#include "app/commands.hpp"
#include "app/engine_certificate.hpp"
#include "app/exit_code.hpp"
#include "app/progress_printer.hpp"
#include "campaign/folder_lock.hpp"
#include "campaign/local_executor.hpp"
#include "campaign/overview.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/shell.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

namespace fs = std::filesystem;

struct Options {
    std::string campaign_file;
    std::string output;
    std::string engine;
    bool accept_failed_probes = false;
    bool accept_findings = false;
    int jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
};

int exit_code_of(campaign::Summary const& summary) {
    if (summary.interrupted) return interrupted;
    return summary.failed + summary.unsure > 0 ? some_cases_failed : all_well;
}

/// Shows what the check warns of. Errors refuse the campaign unless the user accepts them.
void check(Options const& options, Campaign const& campaign) {
    CheckReport const report = check_campaign(campaign);
    print_warnings(report, options.campaign_file);
    if (report.errors() == 0 || options.accept_findings) return;
    throw InputError(
        fmt::format("{}: {}; mend it, see 'vibrotrough check', or run all the same with --accept-findings",
                    options.campaign_file, report.first_error()));
}

int run(Options const& options) {
    Campaign const campaign = read_campaign(options.campaign_file);
    std::optional<fs::path> const asked =
        options.engine.empty() ? std::nullopt : std::optional<fs::path>(options.engine);
    engine::Engine engine = engine::find_engine(asked);
    fs::path const folder =
        options.output.empty() ? fs::path("runs") / campaign.name : fs::path(options.output);
    make_folder(folder);
    {
        // That there is no place, or another driver, is known before anything else is done.
        campaign::FolderLock const free_for_us(folder);
    }
    check(options, campaign);
    if (!certify(engine, options.accept_failed_probes)) return interrupted;
    campaign::Plan const plan = campaign::make_plan(campaign, folder, engine.version);

    campaign::Summary summary;
    {
        ProgressPrinter printer;
        summary = campaign::run_locally(plan, options.campaign_file, engine, options.jobs, printer);
    }
    campaign::write_campaign_file(plan);
    std::size_t const left =
        plan.cases.size() - static_cast<std::size_t>(summary.finished + summary.unsure + summary.failed);
    fmt::print("{} of {} cases finished", summary.finished, plan.cases.size());
    if (summary.unsure > 0) fmt::print(", {} not steady or not precise", summary.unsure);
    if (summary.failed > 0) fmt::print(", {} failed", summary.failed);
    if (left > 0) fmt::print(", {} left", left);
    fmt::print("{}\n", summary.interrupted ? "; interrupted: the same command goes on where it stopped" : "");
    fmt::print("results in {}; see them with: vibrotrough compare {}\n", folder.string(), shell_word(folder));
    return exit_code_of(summary);
}

}  // namespace

void add_run(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<Options>();
    CLI::App* const command =
        program.add_subcommand("run", "Run every case of a campaign that is not finished");
    command->add_option("CAMPAIGN.toml", options->campaign_file, "The campaign file (see the README)")
        ->required();
    command->add_option("--output", options->output, "Folder of the campaign's results; default runs/<name>")
        ->type_name("DIR");
    command->add_option("--jobs", options->jobs, "Engines that run at a time")
        ->check(CLI::Range(1, 4096))
        ->capture_default_str();
    command->add_option("--liggghts", options->engine, "The LIGGGHTS program; default: liggghts on the PATH")
        ->type_name("PATH");
    command->add_flag("--accept-failed-probes", options->accept_failed_probes,
                      "Run although the engine failed its probes (see probe-engine)");
    command->add_flag("--accept-findings", options->accept_findings,
                      "Run although the check of the campaign found errors (see check)");
    command->footer(
        "The campaign is checked first, see 'vibrotrough check --help'. The engine is probed once per "
        "binary, see\n'vibrotrough probe-engine --help'.\n"
        "Ctrl-C stops cleanly, and the same command goes on where it stopped: a finished case is never run "
        "again.\n"
        "Exit codes: 0 all cases finished; 1 some failed, or were not steady or not precise; 2 the input is "
        "wrong;\n"
        "3 something is missing (no liggghts, one that failed its probes, no disk);\n130 interrupted.\n"
        "Example: vibrotrough run validation/demo/campaign.toml --output runs/demo --jobs 2");
    command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vibrotrough::app
