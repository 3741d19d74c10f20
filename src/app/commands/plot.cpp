#include "app/commands.hpp"
#include "app/exit_code.hpp"
#include "app/python.hpp"
#include "app/report_data.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

namespace fs = std::filesystem;

struct Options {
    std::string folder, output, python;
    std::vector<std::string> cases, only;
    bool report = false;
};

fs::path output_folder(Options const& options) {
    return options.output.empty() ? fs::path(options.folder) / "report" : fs::path(options.output);
}

void check_cases(Options const& options, campaign::Plan const& plan) {
    for (std::string const& id : options.cases) {
        if (std::ranges::any_of(plan.cases, [&](auto const& planned) { return planned.id == id; })) continue;
        throw core::InputError(fmt::format("--case: {} has no case {}; 'vibrotrough status {}' lists them",
                                           options.folder, id, options.folder));
    }
}

int run(Options const& options) {
    campaign::Plan const plan = campaign::open_plan(options.folder);
    check_cases(options, plan);
    fs::path const output = output_folder(options);
    bool const finished = write_report_data(plan, output / "data") > 0;
    if (!finished && !options.report) {
        throw core::InputError(
            fmt::format("{} holds no finished case yet; 'vibrotrough status {}' tells more", options.folder,
                        options.folder));
    }
    std::vector<std::string> modules{"numpy", "h5py", "matplotlib"};
    if (options.report) modules.emplace_back("jinja2");
    std::vector<std::string> arguments{options.folder, "--output", output.string()};
    std::vector<std::string> drawing = arguments;
    for (std::string const& kind : options.only) drawing.insert(drawing.end(), {"--only", kind});
    for (std::string const& id : options.cases) drawing.insert(drawing.end(), {"--case", id});
    if (finished) run_script("figures.py", drawing, options.python, modules);
    if (options.report) run_script("report.py", arguments, options.python, modules);
    return all_well;
}

std::shared_ptr<Options> add_common(CLI::App& command) {
    auto const options = std::make_shared<Options>();
    command.add_option("DIR", options->folder, "The campaign's folder, as given to run --output")->required();
    command.add_option("--output", options->output, "Folder to write to; default DIR/report")
        ->type_name("DIR");
    command
        .add_option("--case", options->cases,
                    "Draw the figures of single cases for this case only; may be given again; default: all")
        ->type_name("ID")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command
        .add_option(
            "--python", options->python,
            "Python with numpy, h5py and matplotlib; default: /usr/bin/python3, else python3 on the PATH")
        ->type_name("PATH");
    return options;
}

}  // namespace

void add_plot(CLI::App& program, int& exit_code) {
    CLI::App* const command =
        program.add_subcommand("plot",
                               "Draw a campaign's figures as SVG and PNG: efficiency against throw number, "
                               "residuals, cycle series");
    auto const options = add_common(*command);
    command->add_option("--only", options->only, "Draw this kind of figure only; may be given again")
        ->check(CLI::IsMember({"efficiency", "residuals", "cycles", "portraits", "profiles"}))
        ->type_name("KIND")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command->footer(
        "KIND is efficiency (DEM with error bars over the theory's lines), residuals (DEM minus theory), and "
        "for each "
        "case\n"
        "cycles (velocity efficiency of every cycle, the discarded start shaded), portraits (layer and point "
        "mass in "
        "phase\n"
        "space) and profiles (velocity over height). Prints the path of every file it wrote. Works while the "
        "campaign "
        "runs.\n"
        "Exit codes: 0 all well; 2 the input is wrong; 3 something is missing (Python with its modules, "
        "disk).\n"
        "Example: vibrotrough plot runs/demo");
    command->callback([options, &exit_code] { exit_code = run(*options); });
}

void add_report(CLI::App& program, int& exit_code) {
    CLI::App* const command = program.add_subcommand(
        "report", "Write one HTML file with a campaign's input, table, figures and failures");
    auto const options = add_common(*command);
    options->report = true;
    command->footer(
        "Writes DIR/report/report.html, which needs no network and no other file, and the figures beside it. "
        "The table "
        "sorts on a\n"
        "click. Works while the campaign runs; the same command renews it.\n"
        "Exit codes: 0 all well; 2 the input is wrong; 3 something is missing (Python with its modules, "
        "disk).\n"
        "Example: vibrotrough report runs/demo");
    command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vibrotrough::app
