#include "app/campaign_run.hpp"
#include "app/commands/command.hpp"
#include "campaign/execute/executors.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "compare/compared_cases.hpp"
#include "compare/contrasts.hpp"
#include "compare/exports.hpp"
#include "compare/select.hpp"
#include "compare/stage_rows.hpp"
#include "compare/table.hpp"
#include "theory/conveyor.hpp"

#include <cstdlib>

#include <sys/ioctl.h>
#include <unistd.h>

namespace vibrotrough::app {
namespace {

struct CompareArguments {
    std::string folder;
    bool json = false;
    bool csv = false;
    bool curves = false;
    bool budget = false;
    bool stages = false;
    std::string against;
    std::string contrast;
    std::string sort;
    std::vector<std::string> filters;
    std::string colour = "auto";

    bool are_differences() const { return !against.empty() || !contrast.empty(); }
};

/// On a terminal the table fits its width and has colour, unless NO_COLOR is set (no-color.org).
compare::TableStyle style_for(std::string const& colour) {
    compare::TableStyle style;
    bool const terminal = ::isatty(STDOUT_FILENO) == 1;
    winsize size{};
    if (terminal && ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0) style.width = size.ws_col;
    char const* const no_colour = std::getenv("NO_COLOR");
    bool const suitable = terminal && (no_colour == nullptr || *no_colour == '\0');
    style.colour = colour == "always" || (colour == "auto" && suitable);
    return style;
}

/// Names the cases whose simulation the atlas contradicts.
void tell_disagreement(std::vector<compare::Row> const& rows) {
    std::vector<std::string> ids;
    for (compare::Row const& row : rows)
        if (compare::disagrees_with_atlas(row)) ids.push_back(row.id);
    if (ids.empty()) return;
    fmt::print(
        "The atlas and the simulation differ by more than both intervals, so that one of them is wrong: {}\n",
        fmt::join(ids, ", "));
}

/// Says once where the theory with restitution, which a sweep of it asks for, has no answer.
void tell_without_restitution(std::vector<compare::Row> const& rows) {
    auto const count = std::ranges::count_if(rows, compare::is_without_restitution);
    if (count == 0) return;
    fmt::print("The theory with restitution has no answer for {} case{}: it takes restitutions up to {}.\n",
               count, count == 1 ? "" : "s", theory::largest_restitution);
}

/// The usual table, or that of differences.
void print_table(std::vector<compare::Row> const& rows, std::span<compare::Column const> columns,
                 campaign::Plan const& plan, CompareArguments const& options) {
    fmt::print("{}", compare::to_table(rows, style_for(options.colour), columns));
    if (options.are_differences()) {
        fmt::print(
            "Numerical errors that both cases have in common cancel; all others are in the interval.\n");
        return;
    }
    if (compare::sweeps_restitution(plan.swept) && !options.stages) tell_without_restitution(rows);
    tell_disagreement(rows);
}

/// The table with both errors.
void print_budget(std::vector<compare::Row> const& rows, std::span<compare::Column const> columns,
                  CompareArguments const& options) {
    fmt::print("{}", compare::to_table(rows, style_for(options.colour), compare::budget_columns(columns)));
    if (std::ranges::any_of(rows, compare::is_expected)) {
        fmt::print(
            "* by what other layers showed; 'vibrotrough convergence {}' measures the error of a case\n",
            core::shell_word(options.folder));
    }
}

void tell_outdated(int cases) {
    if (cases == 0) return;
    tell(
        "vibrotrough: left aside: observables of {} case{}, which belong to an earlier result; "
        "'vibrotrough observe' "
        "measures them again\n",
        cases, cases == 1 ? "" : "s");
}

int run_compare(CompareArguments const& options) {
    campaign::Plan const plan = campaign::open_plan(options.folder);
    compare::ComparedCases compared = compare::compared_cases(plan, campaign::activity_in(plan.folder));
    auto& rows = compared.rows;
    auto& columns = compared.columns;
    tell_left_aside(plan, compared.cases);
    tell_outdated(compared.outdated);
    if (options.stages) {
        rows = compare::stage_rows(compared);
        columns = compare::stage_columns(columns);
    }
    if (options.are_differences()) {
        rows = options.against.empty() ? compare::contrast_rows_of(plan, compared, options.contrast)
                                       : compare::contrast_rows_against(compared, options.against);
        columns = compare::contrast_columns(columns, plan.swept);
    }
    for (std::string const& condition : options.filters) rows = compare::filtered(rows, condition, columns);
    if (!options.sort.empty()) rows = compare::sorted(std::move(rows), options.sort, columns);
    auto const print = [](std::string_view piece) { fmt::print("{}", piece); };
    if (options.json) {
        compare::write_json(rows, columns, print);
    } else if (options.curves) {
        fmt::print("{}", compare::theory_curves_csv(rows));
    } else if (options.csv) {
        compare::write_csv(rows, columns, print);
    } else if (options.budget) {
        print_budget(rows, columns, options);
    } else {
        print_table(rows, columns, plan, options);
    }
    return all_well;
}

constexpr char const* what_the_columns_mean =
    R"(The columns of the table. After the case comes a column for every key that the campaign sweeps, under
the name that it has in the campaign file; --sort and --filter take these names, too:

  eta DEM     velocity efficiency of the simulated layer: its mean velocity relative to the trough
              over omega r cos(beta), +- its half-width for statistics and numerics together
  eta theory  velocity efficiency of a point mass at the friction of a grain on the trough (at mu)
              and, after 'vibrotrough friction-test', at that of the whole layer (at mu layer)
  eta point   velocity efficiency of a point mass with the friction of a grain under the normal
              force that the layer exerts (its force). Where it differs from the theory, the cause
              is how the layer presses on the trough. Where the layer differs from it, the cause
              is how the grains pass friction on. Both hold to about 0.05.
  difference  eta DEM minus eta theory at mu. In colour: yellow where the layer is faster than the
              theory, cyan where it is slower, bold from 0.1 on, plain within the interval
  mass flow   of the simulated layer, +- its half-width, likewise: of the whole trough when
              its width is known (trough.width, or side walls), else per metre of width
  mode        how the theory's point mass and the layer move within a period

With --stages, speed is that of the layer at the end of the stage and theory that of a point mass for which the drive of
this stage never ends; 'distance' is how far the layer moves in the stage, and 'to speed' the time until its speed has
changed by 95 % of what it changes.

When the restitution of grains on the trough is swept, the table has both theories: 'plastic' is the paper's, which lands
without a rebound whatever the restitution, and 'restitution' that of a point mass with the case's. Its half-width is given
where it has no period. JSON, CSV and campaign.h5 always have both.

With --against CASE, each line is a case less that one, and with --contrast KEY a case less the first of those that differ
from it in this key alone. The interval is Welch's, from the packings of both, and has the numerical errors in it that do
not cancel: cases that differ only in friction, restitution, rotation or rolling friction have theirs in common. 'significant'
says whether the difference is larger than its half-width. Intervals of the cases that overlap do not show that they are equal.

With --budget, eta DEM is followed by +- its statistical and +- its numerical error: half the width of the confidence
interval of the packings, and how far Young's modulus, box and time step are from their limits. < marks a bound at 95 %
that is known beforehand. 'vibrotrough convergence' replaces it by the error of the case itself; a star marks one that was
measured at the nearest case of the campaign and not at this one. 'larger error' says which of the two is larger: more
cycles do not help where it is the numerical one.

)";

constexpr char const* examples = R"(

Examples:
  vibrotrough compare runs/demo --csv > demo.csv
  vibrotrough compare runs/demo --filter 'throw_number>1.8' --sort difference:desc
  vibrotrough compare runs/mine --filter 'grains.rolling_friction<0.1'
  vibrotrough compare runs/mine --contrast grains.rotation
  vibrotrough compare runs/stages --stages)";

void add_options_of_differences(CLI::App& command, CompareArguments& options) {
    CLI::Option* const against = command.add_option(
        "--against", options.against,
        "Print the differences of the velocity efficiency of every case from this one, with their intervals");
    CLI::Option* const contrast = command.add_option(
        "--contrast", options.contrast,
        "Print the differences between cases that differ only in this key, each less the first");
    against->type_name("CASE")->excludes(contrast);
    contrast->type_name("KEY");
    for (CLI::Option* const one : {against, contrast})
        for (char const* const other : {"--theory-curves", "--budget", "--stages"}) one->excludes(other);
}

void add_options(CLI::App& command, CompareArguments& options) {
    command.add_option("DIR", options.folder, "Folder of the campaign's results, as given to run --output")
        ->required();
    CLI::Option* const json = command.add_flag("--json", options.json, "Print JSON for scripts");
    CLI::Option* const csv =
        command.add_flag("--csv", options.csv, "Print CSV with the same columns as --json")->excludes(json);
    command
        .add_flag("--theory-curves", options.curves,
                  "Print fine curves of the theory through the cases as CSV, for figures")
        ->excludes(json)
        ->excludes(csv);
    command
        .add_flag("--budget", options.budget,
                  "Print the table with both errors of the simulation apart, statistical and numerical. "
                  "JSON and CSV always have both")
        ->excludes(json)
        ->excludes(csv);
    command
        .add_flag(
            "--stages", options.stages,
            "Print a line for each stage of drives with [[stages]]: what the layer does in it, and what "
            "the theory says of its drive")
        ->excludes("--theory-curves")
        ->excludes("--budget");
    add_options_of_differences(command, options);
    add_text(command, "--sort", options.sort,
             "Sort by a column of the JSON or by 'difference' (DEM minus theory), for example "
             "difference:desc",
             "COLUMN[:desc]");
    add_repeated(command, "--filter", options.filters,
                 "Keep only the cases in which a column of the JSON (or 'difference') is > >= < <= = or != a "
                 "value. Repeat the option for further conditions",
                 "CONDITION");
    command
        .add_option("--color", options.colour,
                    "Colour the table: auto means on a terminal where NO_COLOR is not set")
        ->check(CLI::IsMember({"auto", "always", "never"}))
        ->capture_default_str();
}

}  // namespace

void add_compare(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<CompareArguments>();
    CLI::App* const command = program.add_subcommand(
        "compare", "Print the measured velocity efficiency of every case beside the point-mass theory");
    add_options(*command, *options);
    command->footer(std::string(what_the_columns_mean) + mode_letters + examples);
    command->callback([options, &exit_code] { exit_code = run_compare(*options); });
}

}  // namespace vibrotrough::app
