#include "app/campaign_run.hpp"

#include "app/commands/common_options.hpp"
#include "app/engine_certificate.hpp"
#include "app/extra_lines.hpp"
#include "app/progress_log.hpp"
#include "app/progress_printer.hpp"
#include "app/standard_streams.hpp"
#include "campaign/schedule/forecast.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "campaign/state/file_lock.hpp"
#include "campaign/state/overview.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/own_program.hpp"
#include "deck/campaign_check.hpp"

#include <algorithm>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::app {
namespace {

namespace fs = std::filesystem;

/// Prints what is not fine on standard error, one line each.
void print_findings(deck::CampaignCheck const& found, std::string const& campaign_file) {
    for (std::string const& remark : found.remarks) tell("{}\n", remark);
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
void check(RunOptions const& options, scenario::Campaign const& campaign) {
    deck::CampaignCheck const found = deck::check_campaign(campaign);
    print_findings(found, options.campaign_file);
    if (found.errors() == 0 || options.accept_findings) return;
    throw core::InputError(
        fmt::format("{}: {}; correct it (see 'vibrotrough check'), or run it anyway with --accept-findings",
                    options.campaign_file, found.first_error()));
}

/// The lines of the key setup can do anything, and a campaign file may come from elsewhere.
/// @throws InputError unless the user has allowed them
void check_setup(RunOptions const& options, scenario::RunSettings const& settings) {
    std::vector<std::string> const& lines = settings.batch(settings.executor).setup;
    if (lines.empty() || options.allow_setup) return;
    throw core::InputError(
        fmt::format("{}: each task would run these lines of run.{}.setup: {}; if they are what you want, "
                    "call the command again with --allow-setup",
                    options.campaign_file, settings.executor, fmt::join(lines, " ; ")));
}

}  // namespace

void tell_left_aside(campaign::Plan const& plan, std::vector<campaign::CaseOverview> const& cases) {
    std::string const words = campaign::describe_left_aside(plan, cases);
    if (!words.empty()) tell("vibrotrough: left aside: {}\n", words);
}

campaign::PlannedCase const& case_named(campaign::Plan const& plan, std::string const& id) {
    auto const found = std::ranges::find(plan.cases, id, &campaign::PlannedCase::id);
    if (found != plan.cases.end()) return *found;
    throw core::InputError(fmt::format("--case: {} has no case {}; 'vibrotrough status {}' lists them",
                                       plan.folder.string(), id, plan.folder.string()));
}

void RunOptions::add_to(CLI::App& command) {
    add_campaign_file(command, campaign_file);
    add_results_folder(command, output);
    command
        .add_option(
            "--jobs", jobs,
            "Number of cores to use. Each engine takes one core, or several when it has several MPI ranks")
        ->check(CLI::Range(1, 4096))
        ->capture_default_str();
    add_engine(command, engine);
    command.add_option("--progress", progress, "How to show progress on standard error")
        ->check(CLI::IsMember({"text", "json", "none"}))
        ->capture_default_str();
    command.add_flag("--quiet", quiet, "Show no progress; the same as --progress none");
    command.add_flag("--accept-failed-probes", accept_failed_probes, accept_failed_probes_help);
    command.add_flag("--accept-findings", accept_findings,
                     "Run although the check of the campaign found errors (see 'vibrotrough check')");
    command.add_flag(
        "--allow-setup", allow_setup,
        "Let the tasks of a cluster run the lines of the key setup, which are commands of the shell");
    add_allow_extra(command, allow_extra);
}

void StudyOptions::add_to(CLI::App& command) {
    add_results_folder(command, output);
    command.add_option("--jobs", jobs, "Engines that run at a time")
        ->check(CLI::Range(1, 4096))
        ->capture_default_str();
    add_engine(command, engine);
    command.add_flag("--accept-failed-probes", accept_failed_probes, accept_failed_probes_help);
    add_allow_extra(command, allow_extra);
}

fs::path results_folder(std::string const& output, std::string const& name) {
    return output.empty() ? fs::path("runs") / name : fs::path(output);
}

engine::Engine engine_at(std::string const& path) {
    return engine::find_engine(path.empty() ? std::nullopt : std::optional<fs::path>(path));
}

campaign::Summary run_study(StudyOptions const& options, engine::Engine const& engine, campaign::Plan& plan,
                            fs::path const& file, scenario::RunSettings const& settings) {
    campaign::Summary summary;
    {
        ProgressPrinter printer;
        summary =
            campaign::run_campaign(plan, file, *campaign::make_policy(), campaign::executor_kind("local"),
                                   {plan.folder, engine, settings, options.jobs, {}, {options.allow_extra}},
                                   campaign::Until::done, printer);
    }
    campaign::write_campaign_file(plan);
    return summary;
}

std::unique_ptr<campaign::Observer> RunOptions::make_observer() const {
    if (quiet || progress == "none") return std::make_unique<NoProgress>();
    if (progress == "json") return std::make_unique<JsonProgress>();
    return std::make_unique<ProgressPrinter>();
}

/// Results of two binaries that call themselves alike would otherwise be mixed in silence.
void tell_other_binary(engine::Engine const& engine, fs::path const& folder) {
    if (!fs::is_regular_file(folder / "engine.json")) return;
    engine::Engine const before = campaign::read_engine(folder);
    if (before.version != engine.version || before.binary_sha256.empty() ||
        before.binary_sha256 == engine.binary_sha256)
        return;
    tell(
        "vibrotrough: {} is another binary of the same version than that of the results in {}; packing.json "
        "of each packing names its own\n",
        engine.program.string(), folder.string());
}

ReadyCampaign prepare_run(RunOptions const& options) {
    scenario::Campaign campaign = scenario::read_campaign(options.campaign_file);
    check_setup(options, campaign.run);
    check_extra_lines(options.campaign_file, campaign.cases, options.allow_extra);
    use_templates(options.templates, campaign.cases);
    engine::Engine engine = engine_at(options.engine);
    fs::path const folder = results_folder(options.output, campaign.name);
    core::make_folder(folder);
    // Fail now, before anything else is done, if the disk is full or another driver works in the folder.
    campaign::lock_campaign(folder);
    check(options, campaign);
    tell_not_covered(campaign.cases);
    bool const is_interrupted = !certify(engine, options.accept_failed_probes) ||
                                !try_meshes(engine, options.campaign_file, campaign.cases);
    tell_other_binary(engine, folder);
    campaign::Plan plan = campaign::make_plan(campaign, folder, engine.version);
    campaign::ExecutorKind const& kind = campaign::executor_kind(campaign.run.executor);
    campaign::ExecutorInputs inputs{folder, engine, campaign.run, options.jobs, core::own_program()};
    inputs.foreign_commands = {options.allow_extra,
                               options.templates.empty() ? nullptr : campaign.cases.front().engine.templates};
    return {std::move(campaign), std::move(plan), &kind, inputs, is_interrupted};
}

campaign::Summary drive_campaign(RunOptions const& options, ReadyCampaign& ready,
                                 campaign::Policy const& policy, campaign::Until until,
                                 campaign::ExecutorKind const& kind) {
    campaign::Summary summary;
    {
        auto const shown = options.make_observer();
        LoggingObserver observer(*shown, ready.plan.folder);
        summary = campaign::run_campaign(ready.plan, options.campaign_file, policy, kind, ready.inputs, until,
                                         observer);
    }
    campaign::write_campaign_file(ready.plan);
    return summary;
}

void size_tasks(ReadyCampaign& ready, std::optional<int> minutes) {
    if (!minutes) return;
    auto const cases =
        campaign::survey(ready.plan, campaign::activity_in(ready.plan.folder), {}, campaign::Trust::stamp);
    ready.inputs.task_duration = *minutes * 60.0;
    ready.inputs.speed = campaign::forecast(cases).speed;
}

}  // namespace vibrotrough::app
