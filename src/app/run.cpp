#include "app/commands.hpp"
#include "app/exit_code.hpp"
#include "app/progress_printer.hpp"
#include "campaign/local_executor.hpp"
#include "campaign/overview.hpp"
#include "campaign/slurm_executor.hpp"
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
    int jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
};

int exit_code_of(campaign::Summary const& summary) {
    if (summary.interrupted) return interrupted;
    return summary.failed + summary.unsure > 0 ? some_cases_failed : all_well;
}

/// Leaves the packings to Slurm and says what it found and did.
int submit(campaign::Plan const& plan, Campaign const& campaign, Options const& options,
           engine::Engine const& engine) {
    fs::path const program = fs::read_symlink("/proc/self/exe");
    campaign::Submission const done =
        campaign::submit_to_slurm(plan, options.campaign_file, engine, campaign.run, program);
    campaign::write_campaign_file(plan);
    fmt::print("{} of {} cases finished", done.finished, plan.cases.size());
    if (done.unsure > 0) fmt::print(", {} not steady or not precise", done.unsure);
    if (done.in_queue > 0) fmt::print("; {} packings are in Slurm's queue already", done.in_queue);
    if (done.submitted > 0) {
        fmt::print("; {} packings submitted as job {}", done.submitted, fmt::join(done.jobs, ", "));
        if (done.again > 0) fmt::print(" ({} of them once more)", done.again);
    }
    fmt::print("\nfollow with: vibrotrough status {}\n", shell_word(plan.folder));
    return done.unsure > 0 && done.submitted + done.in_queue == 0 ? some_cases_failed : all_well;
}

int run(Options const& options) {
    Campaign const campaign = read_campaign(options.campaign_file);
    std::optional<fs::path> const asked =
        options.engine.empty() ? std::nullopt : std::optional<fs::path>(options.engine);
    engine::Engine const engine = engine::find_engine(asked);
    fs::path const folder =
        options.output.empty() ? fs::path("runs") / campaign.name : fs::path(options.output);
    campaign::Plan const plan = campaign::make_plan(campaign, folder, engine.version);

    if (campaign.run.executor == ExecutorKind::slurm) return submit(plan, campaign, options, engine);
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
    command->footer(
        "Ctrl-C stops cleanly, and the same command goes on where it stopped: a finished case is never run "
        "again.\n"
        "Exit codes: 0 all cases finished; 1 some failed, or were not steady or not precise; 2 the input is "
        "wrong;\n"
        "3 something is missing (no liggghts, no disk); 130 interrupted.\n"
        "With executor = \"slurm\" under [run] the packings are submitted as job arrays and the command "
        "returns;\n"
        "the same command sees which tasks died and submits them again.\n"
        "Example: vibrotrough run validation/demo/campaign.toml --output runs/demo --jobs 2");
    command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vibrotrough::app
