#include "app/commands.hpp"
#include "app/exit_code.hpp"
#include "campaign/execute/packing_worker.hpp"
#include "campaign/execute/slurm_batch.hpp"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

struct Options {
    std::string folder;
    std::string task_list;
    int index = 0;
    double time_limit = 0;
    campaign::WorkLimits limits;
};

int run(Options& options) {
    if (options.time_limit > 0) options.limits.time_limit = options.time_limit;
    campaign::PackingId const packing = campaign::read_task(options.task_list, options.index);
    campaign::WorkResult const result =
        campaign::work(options.folder, packing, options.limits, *campaign::make_policy());
    fmt::print("{}\n", result.message);
    switch (result.kind) {
        case campaign::WorkResult::finished:
        case campaign::WorkResult::busy:
            return all_well;
        case campaign::WorkResult::failed:
            return some_cases_failed;
        case campaign::WorkResult::interrupted:
            break;
    }
    return interrupted;
}

}  // namespace

void add_work(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<Options>();
    CLI::App* const command =
        program.add_subcommand("work", "Run one packing of a campaign: what a task on a cluster does");
    command->add_option("DIR", options->folder, "The campaign's folder")->required();
    command->add_option("--task-list", options->task_list, "A line '<case id> <packing>' per task")
        ->type_name("FILE")
        ->required();
    command->add_option("--index", options->index, "Of the task in its list, from 0")
        ->check(CLI::Range(0, 1'000'000))
        ->required();
    command->add_option("--ranks", options->limits.ranks, "MPI ranks of the engine")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    command->add_option("--retries", options->limits.retries, "After an end that may not come again")
        ->check(CLI::Range(0, 100))
        ->capture_default_str();
    command->add_option("--time-limit", options->time_limit, "Wall clock for the packing, s")
        ->check(CLI::Range(1.0, 3e7));
    command->footer(
        "The job script that 'vibrotrough run' writes for Slurm calls this; other schedulers can as well. "
        "Any "
        "number of\n"
        "these may work on one campaign at once: a packing is run by one of them, and the one that ends a "
        "case's last\n"
        "packing puts its result together.\n"
        "Exit codes: 0 the packing is finished, or another process is at it; 1 it failed, failure.json says "
        "why; 2 there\n"
        "is no such task; 3 something is missing (another engine than planned, no disk); 130 interrupted.\n"
        "Example: vibrotrough work runs/demo --task-list runs/demo/slurm/0001/tasks.txt --index 0");
    command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vibrotrough::app
