#include "app/commands.hpp"
#include "app/commands/common_options.hpp"
#include "app/python.hpp"
#include "core/own_program.hpp"
#include "core/parallel.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

namespace fs = std::filesystem;

struct ValidateArguments {
    std::vector<std::string> names;
    std::string output = "runs/validation", runs = "runs", python;
    bool list = false, long_ones = false, store = false, verbose = false, page = false, claims = false;
    int jobs = core::count_available_cores();
    int points = 300;
};

/// The command line of validate.py.
std::vector<std::string> script_arguments(ValidateArguments const& options) {
    std::vector<std::string> all = options.names;
    all.insert(all.end(),
               {"--program", core::own_program().string(), "--output", fs::absolute(options.output).string(),
                "--runs", fs::absolute(options.runs).string(), "--jobs", std::to_string(options.jobs),
                "--points", std::to_string(options.points)});
    if (options.list) all.emplace_back("--list");
    if (options.long_ones) all.emplace_back("--long");
    if (options.store) all.emplace_back("--store");
    if (options.verbose) all.emplace_back("--verbose");
    if (options.page) all.emplace_back("--page");
    if (options.claims) all.emplace_back("--claims");
    return all;
}

}  // namespace

void add_validate(CLI::App& program, int& exit_code) {
    CLI::App* const command = program.add_subcommand(
        "validate", "Compare this program with the paper, exact solutions and published measurements");
    auto const options = std::make_shared<ValidateArguments>();
    command->add_option("NAME", options->names, "Validation cases, see --list; all when none is given")
        ->type_name("");
    command->add_flag("--list", options->list,
                      "List the validation cases with their latest stored verdicts, and run nothing");
    command->add_flag(
        "--long", options->long_ones,
        "Run the simulations of the long cases, which take minutes to an hour each; without it their "
        "stored tables are judged again");
    command
        ->add_option("--output", options->output,
                     "Folder for tables, figures, verdicts and logs, one folder per validation case")
        ->capture_default_str()
        ->type_name("DIR");
    command
        ->add_option("--runs", options->runs,
                     "Folder for the simulations; those that were stopped continue from there")
        ->capture_default_str()
        ->type_name("DIR");
    command->add_option("--jobs", options->jobs, "Simulations at a time; default: the number of cores")
        ->check(CLI::Range(1, 4096));
    command
        ->add_option("--points", options->points, "Number of points along each axis of a map of the theory")
        ->capture_default_str()
        ->check(CLI::Range(10, 5000));
    command->add_flag("--store", options->store,
                      "Keep tables, figures and verdicts in validation/ itself and write its page again");
    command->add_flag("--page", options->page, "Print the page of stored verdicts, and run nothing");
    command->add_flag(
        "--claims", options->claims,
        "Compare the numbers in README files that come from stored tables with these tables, and "
        "run nothing; with --store, write the numbers");
    command->add_flag("--verbose", options->verbose,
                      "Show what the validation cases print instead of writing it to their logs");
    add_python(*command, options->python);
    command->footer(
        R"(A validation case passes when all its criteria are met. Each has a negative control: a deliberate
error that its criteria must detect.

Example:
  vibrotrough validate theory_table_1 theory_exact --verbose)");
    command->callback([options, &exit_code] {
        exit_code = script_exit_code("validate.py", script_arguments(*options), options->python,
                                     {"numpy", "h5py", "matplotlib"});
    });
}

}  // namespace vibrotrough::app
