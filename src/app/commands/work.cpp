#include "app/commands/command.hpp"
#include "app/extra_lines.hpp"
#include "campaign/execute/packing_worker.hpp"
#include "campaign/execute/task_list.hpp"
#include "campaign/schedule/until_precise.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "learn/learner.hpp"

#include <cstdio>

namespace vibrotrough::app {
namespace {

struct WorkArguments {
    std::string folder;
    std::string task_list;
    int index = 0;
    double time_limit = 0;
    bool allow_extra = false;
    bool is_learning = false;
    campaign::WorkLimits limits;
};

int run_work(WorkArguments& options) {
    options.limits.foreign_commands = {options.allow_extra};
    if (options.time_limit > 0) options.limits.time_limit = options.time_limit;
    // The campaign's folder names the program that is started; whoever looks at the output shall see which.
    tell("engine: {}\n", campaign::read_engine(options.folder).program.string());
    // The policy must be that of the driver, or neither ever finds what the other one wants.
    auto const policy = campaign::make_policy(
        options.is_learning ? learn::read_wanted_half_widths(options.folder) : campaign::HalfWidths{});
    int worst = all_well;
    for (campaign::PackingId const& packing : campaign::read_task(options.task_list, options.index)) {
        campaign::WorkResult const result = campaign::work(options.folder, packing, options.limits, *policy);
        fmt::print("{}\n", result.message);
        std::fflush(stdout);  // a task that is killed later has said what became of this packing
        if (result.kind == campaign::WorkResult::interrupted) return interrupted;
        // A packing that failed does not stop the others.
        if (result.kind == campaign::WorkResult::failed) worst = some_cases_failed;
    }
    return worst;
}

}  // namespace

void add_work(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<WorkArguments>();
    CLI::App* const command =
        program.add_subcommand("work", "Simulate the packings of one task, as a cluster does");
    add_campaign_folder(*command, options->folder);
    command
        ->add_option("--task-list", options->task_list,
                     "File with a line for each task: '<case id> <packing>' once or several times")
        ->type_name("FILE")
        ->required();
    command->add_option("--index", options->index, "Line of the task in the list, counted from 0")
        ->check(CLI::Range(0, 1'000'000))
        ->required();
    command->add_option("--ranks", options->limits.ranks, "MPI ranks of the engine")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    command
        ->add_option("--retries", options->limits.retries,
                     "How often to try again after a failure that may not happen again")
        ->check(CLI::Range(0, 100))
        ->capture_default_str();
    command
        ->add_option("--time-limit", options->time_limit, "Longest wall-clock time of a packing in seconds")
        ->check(CLI::Range(1.0, 3e7));
    add_allow_extra(*command, options->allow_extra);
    command->add_flag(
        "--learning", options->is_learning,
        "Aim at the half-widths that 'vibrotrough learn' or 'calibrate' wants of the cases, instead of "
        "measure.half_width");
    command->footer(
        R"(The job script that 'vibrotrough run' writes for a cluster calls this command; for other schedulers
'vibrotrough prepare' writes the list. Any number of these processes may work on one campaign at the same time: each
packing is simulated by one of them, and the process that ends the last packing of a case writes the result of the case.
A task with several packings simulates them one after the other; what is finished stays finished when it dies.

Example:
  vibrotrough work runs/demo --task-list runs/demo/tasks.txt --index 0)");
    command->callback([options, &exit_code] { exit_code = run_work(*options); });
}

}  // namespace vibrotrough::app
