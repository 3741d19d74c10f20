#include "app/campaign_run.hpp"
#include "app/commands/command.hpp"
#include "app/figure_kinds.hpp"
#include "app/python.hpp"
#include "campaign/execute/executors.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "campaign/state/overview.hpp"
#include "compare/compared_cases.hpp"
#include "compare/report_data.hpp"
#include "compare/select.hpp"
#include "core/quantity.hpp"
#include "scenario/reader/keys.hpp"

namespace vibrotrough::app {
namespace {

constexpr char const* drawing_script = "vibrotrough.figures.draw";

struct PlotArguments {
    std::string folder, output, python;
    std::vector<std::string> cases, only, formats;
    std::string width, style;
    std::string x, y, by, unit;       ///< of the figure of any two columns
    std::vector<std::string> others;  ///< folders of further campaigns in that figure
    bool report = false;
};

fs::path output_folder(PlotArguments const& options) {
    return options.output.empty() ? fs::path(options.folder) / "report" : fs::path(options.output);
}

/// Widths of a column and of a page of Granular Matter and other journals of Springer, m.
constexpr double one_column = 0.084, two_columns = 0.174;

double read_width(std::string const& text) {
    if (text == "one-column") return one_column;
    if (text == "two-columns") return two_columns;
    try {
        double const width = core::parse_quantity(text, "m");
        if (width >= 0.05 && width <= 1) return width;
    } catch (core::QuantityError const&) {
    }
    throw core::InputError(fmt::format(
        "--width {}: write one-column, two-columns, or a width from 50 mm to 1 m such as \"90 mm\"", text));
}

/// @throws core::InputError when there is no such file
void check_style(std::string const& path) {
    try {
        core::read_given_file(path);
    } catch (core::MissingError const& error) {
        throw core::InputError(
            fmt::format("--style {}: {}; write the path of a style sheet of matplotlib", path, error.what()));
    }
}

/// What the options say of files and sizes, for the script that draws.
std::vector<std::string> words_for_print(PlotArguments const& options) {
    std::vector<std::string> words;
    for (std::string const& format : options.formats) words.insert(words.end(), {"--format", format});
    if (!options.width.empty())
        words.insert(words.end(), {"--width", fmt::format("{}", read_width(options.width))});
    if (!options.style.empty()) {
        check_style(options.style);
        words.insert(words.end(), {"--style", fs::absolute(options.style).lexically_normal().string()});
    }
    return words;
}

/// A column that can be an axis.
compare::Column const& number_named(std::span<compare::Column const> columns, char const* option,
                                    std::string const& name) {
    compare::Column const& column = compare::column_named(columns, option, name);
    if (column.type() == compare::ColumnType::text)
        throw core::InputError(fmt::format("{}: {} is not a number; --by takes words", option, column.name));
    return column;
}

/// What a number of a column is multiplied with to be in another unit.
double factor_to(std::string const& unit, compare::Column const& column) {
    try {
        return core::parse_quantity("1 " + column.unit, unit);
    } catch (core::QuantityError const& error) {
        throw core::InputError(
            fmt::format("--unit {}: {}; {} is in {}", unit, error.what(), column.name, column.unit));
    }
}

/// The campaign, with its campaign.h5 renewed where results came in by hand. A key of the campaign file that
/// is an axis then has its column, also where this campaign does not vary it.
campaign::Plan open_for_figures(std::string const& folder, PlotArguments const& options) {
    campaign::Plan plan = campaign::open_plan(folder);
    if (campaign::is_campaign_file_outdated(plan)) campaign::write_campaign_file(plan);
    for (std::string const& name : {options.x, options.y, options.by}) {
        scenario::Key const* const key = scenario::find_key(name);
        if (key != nullptr && std::ranges::find(plan.swept, key) == plan.swept.end())
            plan.swept.push_back(key);
    }
    return plan;
}

/// The figure of any two columns, for the script that draws: its options, and what the program knows of the
/// other campaigns, which is written into their folders as for their own figures.
std::vector<std::string> words_for_columns(PlotArguments const& options, campaign::Plan const& plan) {
    bool const is_asked = !options.x.empty() || !options.y.empty();
    if (!is_asked && (!options.by.empty() || !options.unit.empty() || !options.others.empty()))
        throw core::InputError(
            "--by, --unit and --with belong to the figure of two columns; write --x COLUMN --y COLUMN");
    if (!is_asked) return {};
    if (options.x.empty() || options.y.empty())
        throw core::InputError(fmt::format("{} is missing; write for example --x layer.height --y speed",
                                           options.x.empty() ? "--x" : "--y"));
    if (!options.only.empty() || !options.cases.empty())
        throw core::InputError(
            "--only and --case choose among the other figures; leave them out with --x and --y");
    auto const columns = compare::columns_of(plan);
    compare::Column const& y = number_named(columns, "--y", options.y);
    std::vector<std::string> words{"--x", std::string(number_named(columns, "--x", options.x).name), "--y",
                                   std::string(y.name)};
    if (!options.by.empty())
        words.insert(words.end(),
                     {"--by", std::string(compare::column_named(columns, "--by", options.by).name)});
    if (!options.unit.empty()) {
        words.insert(words.end(),
                     {"--unit", options.unit, "--factor", fmt::format("{}", factor_to(options.unit, y))});
    }
    for (std::string const& folder : options.others) {
        campaign::Plan const other = open_for_figures(folder, options);
        fs::path const output = fs::path(folder) / "report";
        core::make_folder(output);
        tell_left_aside(
            other, compare::write_report_data(other, campaign::activity_in(other.folder), output / "data"));
        words.insert(words.end(), {"--with", fs::absolute(output).lexically_normal().string()});
    }
    return words;
}

int run_plot(PlotArguments const& options) {
    std::vector<std::string> const print = words_for_print(options);
    campaign::Plan const plan = open_for_figures(options.folder, options);
    std::vector<std::string> const columns = words_for_columns(options, plan);
    for (std::string const& id : options.cases) case_named(plan, id);
    fs::path const output = output_folder(options);
    core::make_folder(output);
    auto const cases = compare::write_report_data(plan, campaign::activity_in(plan.folder), output / "data");
    tell_left_aside(plan, cases);
    bool const finished = std::ranges::any_of(cases, [](auto const& one) { return one.result.has_value(); });
    if (!finished && !options.report) {
        throw core::InputError(fmt::format("{} holds no finished case yet; see 'vibrotrough status {}'",
                                           options.folder, options.folder));
    }
    std::vector<std::string> modules{"numpy", "h5py", "matplotlib"};
    if (options.report) modules.emplace_back("jinja2");
    std::vector<std::string> arguments{fs::absolute(options.folder).lexically_normal().string(), "--output",
                                       fs::absolute(output).lexically_normal().string()};
    std::vector<std::string> drawing = arguments;
    drawing.insert(drawing.end(), print.begin(), print.end());
    drawing.insert(drawing.end(), columns.begin(), columns.end());
    for (std::string const& kind : options.only) drawing.insert(drawing.end(), {"--only", kind});
    for (std::string const& id : options.cases) drawing.insert(drawing.end(), {"--case", id});
    if (finished) {
        int const code = script_exit_code(drawing_script, drawing, options.python, modules);
        if (code == wrong_input) return wrong_input;  // it has said what
        check_script(drawing_script, code);
    }
    if (options.report) run_script("vibrotrough.report.page", arguments, options.python, modules);
    return all_well;
}

/// The options of both commands.
std::shared_ptr<PlotArguments> add_common(CLI::App& command) {
    auto const options = std::make_shared<PlotArguments>();
    add_campaign_folder(command, options->folder);
    add_text(command, "--output", options->output, "Folder to write to; default DIR/report", "DIR");
    add_repeated(command, "--case", options->cases,
                 "Draw the figures of single cases only for this case; repeat the option for several; "
                 "default: all",
                 "ID");
    add_python(command, options->python);
    return options;
}

/// The kinds of figures, and what the help says of them.
std::pair<std::vector<std::string>, std::string> known_figures() {
    std::vector<std::string> kinds;
    std::string help = "Kinds of figures:\n";
    for (Json const& row : Json::parse(figure_kinds.front().second)) {
        kinds.push_back(row["kind"]);
        help +=
            fmt::format("  {:<11} {}{}\n", kinds.back(), row["file"] == "result.h5" ? "for each case: " : "",
                        row["title"].get<std::string>());
    }
    return {kinds, help + "\n"};
}

constexpr char const* plot_help =
    R"(With --x and --y, one figure shows any column of 'vibrotrough compare' over any other, with its interval, and for
speed, efficiency and mass flow what the theory and the rolling-layer law say of the same cases. A column is named as in
'compare --csv', without its unit if you like, or as its key in the campaign file.

Prints the path of every file that it wrote. Works while the campaign runs. With --width, letters shrink less than the
figure, down to 7 points, and PNG has 300 dots per inch. A figure with panels beside one another needs 150 mm: in one column it is left out, and a line on standard error says so. PDF holds its fonts, as journals ask. The widths are those of Granular
Matter (Springer); Elsevier's are 90 mm and 190 mm. A style sheet can name programs that matplotlib starts, such as LaTeX
(text.usetex): use your own.

Example:
  vibrotrough plot runs/demo
  vibrotrough plot runs/demo --format pdf --width one-column --only efficiency --output figures
  vibrotrough plot runs/deep --with runs/shallow --x layer.height --y speed --unit m/min)";

}  // namespace

void add_plot(CLI::App& program, int& exit_code) {
    CLI::App* const command =
        program.add_subcommand("plot", "Draw the figures of a campaign as SVG and PNG, or as PDF");
    auto const options = add_common(*command);
    auto const [kinds, kinds_help] = known_figures();
    command
        ->add_option("--only", options->only, "Draw only this kind of figure; repeat the option for several")
        ->check(CLI::IsMember(kinds).description(""))  // they are named below, with what each shows
        ->type_name("KIND")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    auto const add_column = [&](char const* name, std::string& column, char const* meaning) {
        add_text(*command, name, column, meaning, "COLUMN");
    };
    add_column("--x", options->x,
               "Draw one figure only: any column of 'compare' over this one, such as layer.height");
    add_column("--y", options->y,
               "The column that is drawn over --x, such as efficiency, speed or mass_flow");
    add_column("--by", options->by, "The column that tells series apart; default: the other swept keys");
    add_text(*command, "--unit", options->unit,
             "Unit of --y, such as m/min or kg/s; default: that of the table", "UNIT");
    add_repeated(*command, "--with", options->others,
                 "Draw the cases of this campaign in the same figure; repeat the option for several", "DIR");
    command
        ->add_option("--format", options->formats,
                     "Write these kinds of files: svg, png, pdf, with commas between them; default svg,png")
        ->check(CLI::IsMember({"svg", "png", "pdf"}))
        ->delimiter(',')
        ->type_name("KIND,...")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    add_text(*command, "--width", options->width,
             "Width of every figure in print: one-column (84 mm), two-columns (174 mm), or a width "
             "such as \"90 mm\"; default: as on a screen",
             "WIDTH");
    add_text(*command, "--style", options->style,
             "A style sheet of matplotlib, for fonts, sizes of letters, axes, ticks and resolution. "
             "Colours and marks that tell series apart stay",
             "FILE");
    command->footer(kinds_help + plot_help);
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

Example:
  vibrotrough report runs/demo)");
    command->callback([options, &exit_code] { exit_code = run_plot(*options); });
}

}  // namespace vibrotrough::app
