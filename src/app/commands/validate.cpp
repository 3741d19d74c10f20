#include "app/commands/command.hpp"
#include "app/python.hpp"
#include "core/own_program.hpp"
#include "core/parallel.hpp"

namespace vibrotrough::app {
namespace {

struct ValidateArguments {
    std::string output = "runs/validation", runs = "runs", python;
    int jobs = core::count_available_cores();
};

/// The words of the command line with what the script does not know: it runs in another folder.
std::vector<std::string> script_arguments(ValidateArguments const& options, std::vector<std::string> words) {
    words.insert(words.end(), {"--program", core::own_program().string(), "--output",
                               fs::absolute(options.output).string(), "--runs",
                               fs::absolute(options.runs).string(), "--jobs", std::to_string(options.jobs)});
    return words;
}

}  // namespace

void add_validate(CLI::App& program, int& exit_code) {
    CLI::App* const command = program.add_subcommand(
        "validate", "Compare this program with the paper, exact solutions and published measurements");
    auto const options = std::make_shared<ValidateArguments>();
    command->allow_extras();
    add_text(*command, "--output", options->output,
             "Folder for tables, figures, verdicts and logs, one folder per validation case; default "
             "runs/validation",
             "DIR");
    add_text(*command, "--runs", options->runs,
             "Folder for the simulations; those that were stopped continue from there; default runs", "DIR");
    command->add_option("--jobs", options->jobs, "Simulations at a time; default: the number of cores")
        ->check(CLI::Range(1, 4096));
    add_python(*command, options->python);
    command->footer(
        R"(All other words go to the script validate.py: the names of validation cases (all when none is given), and

  --list      list the cases with their latest stored verdicts, and run nothing
  --long      run the simulations of the long cases, which take minutes to an hour each; without it
              their stored tables are judged again
  --points N  number of points along each axis of a map of the theory; default 300
  --store     keep tables, figures and verdicts in validation/ itself
  --page      print the stored verdicts and findings in Markdown, and run nothing
  --claims    compare the numbers in pages with the stored tables that they come from,
              and run nothing; with --store, write the numbers
  --verbose   show what the cases print instead of writing it to their logs

A validation case passes when all its criteria are met. Each has a negative control: a deliberate
error that its criteria must detect.

Example:
  vibrotrough validate theory_table_1 theory_exact --verbose)");
    command->callback([command, options, &exit_code] {
        exit_code = script_exit_code("validate", script_arguments(*options, command->remaining()),
                                     options->python, {"numpy", "h5py", "matplotlib"});
    });
}

}  // namespace vibrotrough::app
