#include "campaign/state/plan.hpp"

#include "app/campaign_run.hpp"
#include "app/commands/command.hpp"
#include "app/extra_lines.hpp"
#include "app/progress_printer.hpp"
#include "campaign/execute/executors.hpp"
#include "campaign/schedule/forecast.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "campaign/state/overview.hpp"
#include "compare/compared_cases.hpp"
#include "compare/exports.hpp"
#include "core/parallel.hpp"

#include <array>

namespace vibrotrough::app {
namespace {

struct PlanArguments {
    std::string campaign_file;
    std::string output;
    std::string engine;
    std::string templates;
    bool json = false;
};

/// The version of the engine that a run would use: the one that the user gives, else the one on the PATH,
/// else the one that the folder was planned with. The ids of the cases depend on it.
std::string engine_version(PlanArguments const& options, fs::path const& folder) {
    if (!options.engine.empty()) return engine::find_engine(fs::path(options.engine)).version;
    try {
        return engine::find_engine(std::nullopt).version;
    } catch (core::Error const&) {
        std::error_code ignored;
        if (fs::is_regular_file(folder / "engine.json", ignored))
            return campaign::read_engine(folder).version;
        throw;
    }
}

std::string_view source_of(campaign::Forecast const& cost) {
    if (cost.results > 0) return "measured in finished cases";
    return cost.is_of_last_campaign ? "measured in the last campaign" : "assumed until the first result";
}

/// Everything that is printed.
struct PlanView {
    scenario::Campaign const& campaign;
    campaign::Plan const& plan;
    std::vector<campaign::CaseOverview> const& cases;
    campaign::Forecast const& cost;
    std::size_t known = 0;  ///< number of cases with a result
};

void print_json(PlanView const& view) {
    auto const columns = compare::columns_with_swept(view.plan.swept);
    auto const describe_case = [&](std::size_t i) {
        campaign::CaseOverview const& one = view.cases[i];
        scenario::Trough const& trough = one.planned->scenario().trough;
        Json object{{"case", one.planned->id},
                    {"label", one.planned->label},
                    {"throw_number", one.planned->prepared->throw_number},
                    {"machine_number", one.planned->prepared->machine_number},
                    {"vibration_angle_deg", scenario::in_degrees(trough.vibration_angle)},
                    {"inclination_deg", scenario::in_degrees(trough.inclination)},
                    {"friction", trough.friction},
                    {"grains", one.planned->scenario().layer.grains},
                    {"packings", view.cost.packings[i]},
                    {"packings_done", one.packings_done},
                    {"outcome", one.label()},
                    {"core_time_s", view.cost.cases[i]}};
        object.update(compare::swept_object(compare::planned_row(view.plan, one), columns));
        return object;
    };
    Json const head{{"campaign", view.plan.name},
                    {"cases_total", view.cases.size()},
                    {"excluded", view.campaign.excluded},
                    {"known", view.known},
                    {"core_time_s", view.cost.core_time},
                    {"speed_grain_steps_per_s", view.cost.speed},
                    {"speed_source", source_of(view.cost)},
                    {"core_time_uncertainty_factor", view.cost.uncertainty},
                    {"left_aside", campaign::count_left_aside(view.plan)},
                    {"cases", Json::array()}};
    print_with_list(head, view.cases.size(), describe_case);
}

/// The columns of the table: the case, the swept keys, and the drive.
std::vector<compare::Column> case_columns(campaign::Plan const& plan) {
    auto columns = compare::columns_with_swept(plan.swept);
    std::erase_if(columns, [&](compare::Column const& column) {
        constexpr std::array<std::string_view, 6> always{
            "case", "throw_number", "machine_number", "friction", "inclination_deg", "vibration_angle_deg"};
        return std::ranges::find(always, column.name) == always.end() &&
               !compare::is_swept(column, plan.swept);
    });
    return columns;
}

/// Prints lines of cells below each other, the first column flush left.
void print_aligned(std::vector<std::vector<std::string>> const& lines) {
    std::vector<std::size_t> widths(lines.front().size(), 0);
    for (auto const& line : lines) {
        for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
    }
    for (auto const& line : lines) {
        std::string text = fmt::format("{:<{}}", line[0], widths[0]);
        for (std::size_t i = 1; i < line.size(); ++i) text += fmt::format("  {:>{}}", line[i], widths[i]);
        fmt::print("{}\n", text);
    }
}

void print_cases(PlanView const& view) {
    auto const columns = case_columns(view.plan);
    std::vector<std::vector<std::string>> lines(2);
    for (compare::Column const& column : columns) {
        bool const is_k = column.name == "machine_number" && !column.terminal;
        lines[0].emplace_back(is_k ? "K" : column.terminal->heading);
        lines[1].emplace_back(is_k ? "" : column.terminal->subheading);
    }
    for (char const* const heading : {"grains", "packings", "outcome", "core time"})
        lines[0].emplace_back(heading);
    lines[1].resize(lines[0].size());
    for (std::size_t i = 0; i < view.cases.size(); ++i) {
        campaign::CaseOverview const& one = view.cases[i];
        compare::Row const row = compare::planned_row(view.plan, one);
        auto& line = lines.emplace_back();
        for (compare::Column const& column : columns) line.push_back(column.shown(row));
        line.push_back(std::to_string(one.planned->scenario().layer.grains));
        line.push_back(fmt::format("{}/{}", one.packings_done, view.cost.packings[i]));
        line.emplace_back(one.label());
        line.push_back(clock_time(view.cost.cases[i]));
    }
    print_aligned(lines);
}

void print_text(PlanView const& view) {
    print_cases(view);
    fmt::print("campaign {}: {} cases, {} with a result", view.plan.name, view.cases.size(), view.known);
    if (view.campaign.excluded > 0) fmt::print(", {} left out by [[exclude]]", view.campaign.excluded);
    if (std::size_t const unused = campaign::count_left_aside(view.plan); unused > 0)
        fmt::print(", {} cases of an earlier version not used", unused);
    int const cores = core::count_available_cores();
    fmt::print(
        "\nestimated cost: {:.3g} core-hours (probably {:.2g} to {:.2g}), {} on {} cores, at {:.2g} "
        "grain-steps per "
        "second and core ({})\n",
        view.cost.core_time / 3600, view.cost.core_time / view.cost.uncertainty / 3600,
        view.cost.core_time * view.cost.uncertainty / 3600, clock_time(view.cost.core_time / cores), cores,
        view.cost.speed, source_of(view.cost));
}

int run_plan(PlanArguments const& options) {
    scenario::Campaign campaign = scenario::read_campaign(options.campaign_file);
    use_templates(options.templates, campaign.cases);
    fs::path const folder = results_folder(options.output, campaign.name);
    campaign::Plan const plan = campaign::make_plan(campaign, folder, engine_version(options, folder));
    campaign.cases = {};  // the plan has its own
    auto const cases = campaign::survey(plan, campaign::activity_in(plan.folder), {}, campaign::Trust::stamp);
    campaign::Forecast const cost = campaign::forecast(cases);
    PlanView view{campaign, plan, cases, cost};
    for (campaign::CaseOverview const& one : cases) view.known += one.result ? 1 : 0;
    options.json ? print_json(view) : print_text(view);
    return all_well;
}

}  // namespace

void add_plan(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<PlanArguments>();
    CLI::App* const command = program.add_subcommand(
        "plan", "List the cases of a campaign, which of them have a result, and what the others will cost");
    add_campaign_file(*command, options->campaign_file);
    add_results_folder(*command, options->output);
    add_engine(*command, options->engine);
    add_templates(*command, options->templates);
    command->add_flag("--json", options->json, "Print JSON for scripts");
    command->footer(
        R"(Prints one line per case: its id, the values of all swept keys, throw number Gamma, machine number K,
vibration angle beta and inclination alpha in degrees, friction coefficient mu, number of grains, packings that have ended and will probably be
needed for the interval that measure.half_width asks for, outcome, and the core time that it still needs. Below, the
cost of the whole campaign is estimated, with the range in which it probably lies. The estimate learns from the cases
that have a result; before the first it takes the speed that the last campaign of plain layers had.

Nothing is simulated, and no file is written. Only the version of the engine is read, because the ids of the cases
depend on it.

Example:
  vibrotrough plan validation/demo/campaign.toml --output runs/demo)");
    command->callback([options, &exit_code] { exit_code = run_plan(*options); });
}

}  // namespace vibrotrough::app
