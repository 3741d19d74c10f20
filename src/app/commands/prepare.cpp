#include "app/campaign_run.hpp"
#include "app/commands/command.hpp"
#include "campaign/execute/campaign_driver.hpp"
#include "campaign/execute/task_list.hpp"
#include "campaign/schedule/policy.hpp"
#include "campaign/state/overview.hpp"

namespace vibrotrough::app {
namespace {

struct PrepareArguments {
    RunOptions shared;
    std::string task_list;
    int minutes = 0;
};

void explain(std::size_t tasks, fs::path const& list, fs::path const& folder,
             campaign::ExecutorInputs const& inputs) {
    fmt::print("run each task, for i from 0 to {}, with:\n  {} work {} --task-list {} --index $i{}\n",
               tasks - 1, core::shell_word(inputs.program), core::shell_word(fs::absolute(folder)),
               core::shell_word(fs::absolute(list)), inputs.foreign_commands.any() ? " --allow-extra" : "");
    fmt::print(
        "when they have ended, call the same 'vibrotrough prepare' again: it lists what is still missing\n");
}

/// Empties the list of an earlier call, which would be run again when nothing is missing any more.
/// @throws core::InputError when the file holds something else, which may be the person's own
void clear_list(fs::path const& list) {
    if (fs::exists(list) && (!fs::is_regular_file(list) || !campaign::read_task_list(list)))
        throw core::InputError(
            fmt::format("{} exists and is not a task list, so it is not replaced; give --task-list "
                        "another file, or remove this one",
                        list.string()));
    core::write_file_atomically(list, "");
}

int run_prepare(PrepareArguments const& options) {
    ReadyCampaign ready = prepare_run(options.shared);
    if (ready.is_interrupted) return interrupted;
    size_tasks(ready, options.minutes > 0 ? std::optional(options.minutes) : std::nullopt);
    fs::path const list = options.task_list;
    clear_list(list);
    ready.inputs.task_list = list;
    campaign::Summary const summary =
        drive_campaign(options.shared, ready, *campaign::make_policy(), campaign::Until::submitted,
                       campaign::executor_kind("task-list"));
    int const ended = summary.finished + summary.unsure + summary.failed;
    fmt::print("{} of {} cases have ended", ended, ready.plan.cases.size());
    if (!summary.references.empty()) fmt::print("; {}", fmt::join(summary.references, "; "));
    fmt::print("\n");
    auto const tasks = campaign::read_task_list(list);
    if (tasks && !tasks->empty()) {
        explain(tasks->size(), list, ready.plan.folder, ready.inputs);
    } else if (summary.references.empty()) {
        fmt::print("nothing is missing; see the results with: vibrotrough compare {}\n",
                   core::shell_word(ready.plan.folder));
    }
    return all_well;
}

}  // namespace

void add_prepare(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<PrepareArguments>();
    CLI::App* const command =
        program.add_subcommand("prepare", "Write a list of tasks for a scheduler that run does not know");
    options->shared.add_to(*command);
    command
        ->add_option("--task-list", options->task_list,
                     "File for the list: a line '<case id> <packing> ...' for each task; empty when nothing "
                     "is missing")
        ->type_name("FILE")
        ->required();
    command
        ->add_option("--minutes-per-task", options->minutes,
                     "Put several packings into a task, so that it takes about this many minutes; default: "
                     "one packing "
                     "per task")
        ->check(CLI::Range(1, 100'000));
    command->footer(
        R"(The campaign is checked, the engine tested, and the decks of all cases that still need packings are
written, as by 'vibrotrough run'; but nothing is simulated. Each line of the list is a task for 'vibrotrough work', which
any scheduler can start, on any machine that sees the folder: LSF, HTCondor, GNU parallel. A campaign goes on in
rounds, because the results decide which packings are needed next: call this command again when the tasks have ended,
until the list is empty. Packings that a task simulates at that moment are left out. The page "Clusters" of the manual
has job scripts for several schedulers.

Example:
  vibrotrough prepare validation/demo/campaign.toml --output runs/demo --task-list tasks.txt
  parallel -j 2 vibrotrough work runs/demo --task-list tasks.txt --index {} ::: $(seq 0 5))");
    command->callback([options, &exit_code] { exit_code = run_prepare(*options); });
}

}  // namespace vibrotrough::app
