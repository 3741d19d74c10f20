#include "app/commands.hpp"
#include "app/commands/common_options.hpp"
#include "app/exit_code.hpp"
#include "app/python.hpp"
#include "campaign/execute/executors.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "compare/report_data.hpp"
#include "core/error.hpp"
#include "core/own_folder.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

namespace fs = std::filesystem;

struct PlotArguments {
    std::string folder, output, python;
    std::vector<std::string> cases, only;
    bool report = false;
};

fs::path output_folder(PlotArguments const& options) {
    return options.output.empty() ? fs::path(options.folder) / "report" : fs::path(options.output);
}

void check_cases(PlotArguments const& options, campaign::Plan const& plan) {
    for (std::string const& id : options.cases) {
        if (std::ranges::any_of(plan.cases, [&](auto const& planned) { return planned.id == id; })) continue;
        throw core::InputError(fmt::format("--case: {} has no case {}; 'vibrotrough status {}' lists them",
                                           options.folder, id, options.folder));
    }
}

int run_plot(PlotArguments const& options) {
    campaign::Plan const plan = campaign::open_plan(options.folder);
    check_cases(options, plan);
    fs::path const output = output_folder(options);
    core::make_folder(output);
    core::OwnFolder const own(output);
    bool const finished =
        compare::write_report_data(plan, campaign::activity_in(plan.folder), output / "data") > 0;
    if (!finished && !options.report) {
        throw core::InputError(fmt::format("{} holds no finished case yet; see 'vibrotrough status {}'",
                                           options.folder, options.folder));
    }
    std::vector<std::string> modules{"numpy", "h5py", "matplotlib"};
    if (options.report) modules.emplace_back("jinja2");
    std::vector<std::string> arguments{fs::absolute(options.folder).lexically_normal().string(), "--output",
                                       fs::absolute(output).lexically_normal().string()};
    std::vector<std::string> drawing = arguments;
    for (std::string const& kind : options.only) drawing.insert(drawing.end(), {"--only", kind});
    for (std::string const& id : options.cases) drawing.insert(drawing.end(), {"--case", id});
    if (finished) run_script("figures.py", drawing, options.python, modules);
    if (options.report) run_script("report.py", arguments, options.python, modules);
    return all_well;
}

/// The options of both commands.
std::shared_ptr<PlotArguments> add_common(CLI::App& command) {
    auto const options = std::make_shared<PlotArguments>();
    add_campaign_folder(command, options->folder);
    command.add_option("--output", options->output, "Folder to write to; default DIR/report")
        ->type_name("DIR");
    command
        .add_option("--case", options->cases,
                    "Draw the figures of single cases only for this case; repeat the option for several; "
                    "default: all")
        ->type_name("ID")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    add_python(command, options->python);
    return options;
}

}  // namespace

void add_plot(CLI::App& program, int& exit_code) {
    CLI::App* const command = program.add_subcommand("plot", "Draw the figures of a campaign as SVG and PNG");
    auto const options = add_common(*command);
    command
        ->add_option("--only", options->only, "Draw only this kind of figure; repeat the option for several")
        ->check(CLI::IsMember(
            {"efficiency", "residuals", "budget", "cycles", "portraits", "spin", "rolling", "profiles"}))
        ->type_name("KIND")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command->footer(R"(Kinds of figures:
  efficiency  velocity efficiency over throw number: DEM with error bars, the theory as lines
  residuals   DEM minus theory
  budget      statistical and numerical error of the cases that 'vibrotrough convergence' studied
  cycles      for each case: velocity efficiency of every cycle, with the discarded start-up shaded
  portraits   for each case: layer and point mass in phase space
  spin        for each case: spin and slip of the floor grains, and friction, over the cycle
  rolling     for each case with measure.rolling: spin, slip and forces at the floor over the cycle
  profiles    for each case: velocity over height

Prints the path of every file that it wrote. Works while the campaign runs.

Exit codes:
    0  all well
    2  the input is wrong, or no case is finished yet
    3  something is missing: Python with its modules, or disk space

Example:
  vibrotrough plot runs/demo)");
    command->callback([options, &exit_code] { exit_code = run_plot(*options); });
}

void add_report(CLI::App& program, int& exit_code) {
    CLI::App* const command = program.add_subcommand(
        "report", "Write one HTML page with the input, table, figures and failures of a campaign");
    auto const options = add_common(*command);
    options->report = true;
    command->footer(
        R"(Writes DIR/report/report.html and the figures beside it. The page is complete in itself and needs no
network. A click on a column's heading sorts the table. The command works while the campaign runs; give it again to
update the page.

Exit codes:
    0  all well
    2  the input is wrong
    3  something is missing: Python with its modules, or disk space

Example:
  vibrotrough report runs/demo)");
    command->callback([options, &exit_code] { exit_code = run_plot(*options); });
}

}  // namespace vibrotrough::app
