#include "campaign/state/plan.hpp"

#include "app/commands.hpp"
#include "app/commands/common_options.hpp"
#include "app/exit_code.hpp"
#include "app/progress_printer.hpp"
#include "campaign/execute/executors.hpp"
#include "campaign/schedule/forecast.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "campaign/state/overview.hpp"
#include "core/error.hpp"

#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct Options {
    std::string campaign_file;
    std::string output;
    std::string engine;
    bool json = false;
};

/// The version of the engine that a run would use: the one that the user gives, else the one on the PATH,
/// else the one that the folder was planned with. The ids of the cases depend on it.
std::string engine_version(Options const& options, fs::path const& folder) {
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
    switch (cost.source) {
        case campaign::Forecast::SpeedSource::results:
            return "measured in finished cases";
        case campaign::Forecast::SpeedSource::certificate:
            return "from the engine's certificate";
        case campaign::Forecast::SpeedSource::assumed:
            break;
    }
    return "assumed until the first result";
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
    Json list = Json::array();
    for (std::size_t i = 0; i < view.cases.size(); ++i) {
        campaign::CaseOverview const& one = view.cases[i];
        scenario::Trough const& trough = one.planned->scenario().trough;
        list.push_back({{"case", one.planned->id},
                        {"throw_number", one.planned->prepared->throw_number},
                        {"machine_number", one.planned->prepared->machine_number},
                        {"vibration_angle_deg", scenario::in_degrees(trough.vibration_angle)},
                        {"inclination_deg", scenario::in_degrees(trough.inclination)},
                        {"friction", trough.friction},
                        {"grains", one.planned->scenario().layer.grains},
                        {"packings", view.cost.packings[i]},
                        {"packings_done", one.packings_done},
                        {"outcome", one.label()},
                        {"core_time_s", view.cost.cases[i]}});
    }
    Json const json{{"campaign", view.plan.name},
                    {"cases_total", view.cases.size()},
                    {"excluded", view.campaign.excluded},
                    {"known", view.known},
                    {"core_time_s", view.cost.core_time},
                    {"speed_grain_steps_per_s", view.cost.speed},
                    {"speed_source", source_of(view.cost)},
                    {"core_time_uncertainty_factor", view.cost.uncertainty},
                    {"left_aside", campaign::count_left_aside(view.plan)},
                    {"cases", list}};
    fmt::print("{}\n", json.dump(2));
}

void print_text(PlanView const& view) {
    fmt::print(
        "case          Gamma       K   beta  alpha    mu   grains  packings  outcome       core time\n");
    for (std::size_t i = 0; i < view.cases.size(); ++i) {
        campaign::CaseOverview const& one = view.cases[i];
        scenario::Scenario const& scenario = one.planned->scenario();
        fmt::print("{}  {:5.3f}  {:6.3f}  {:5.2f}  {:5.2f}  {:4.2f}  {:7}  {:>4}/{:<3}  {:<12}  {:>9}\n",
                   one.planned->id, one.planned->prepared->throw_number,
                   one.planned->prepared->machine_number,
                   scenario::in_degrees(scenario.trough.vibration_angle),
                   scenario::in_degrees(scenario.trough.inclination), scenario.trough.friction,
                   scenario.layer.grains, one.packings_done, view.cost.packings[i], one.label(),
                   clock_time(view.cost.cases[i]));
    }
    fmt::print("campaign {}: {} cases, {} with a result", view.plan.name, view.cases.size(), view.known);
    if (view.campaign.excluded > 0) fmt::print(", {} left out by [[exclude]]", view.campaign.excluded);
    if (std::size_t const unused = campaign::count_left_aside(view.plan); unused > 0)
        fmt::print(", {} cases of an earlier version not used", unused);
    unsigned const cores = std::max(1u, std::thread::hardware_concurrency());
    fmt::print(
        "\nestimated cost: {:.3g} core-hours (probably {:.2g} to {:.2g}), {} on {} cores, at {:.2g} "
        "grain-steps per "
        "second and core ({})\n",
        view.cost.core_time / 3600, view.cost.core_time / view.cost.uncertainty / 3600,
        view.cost.core_time * view.cost.uncertainty / 3600, clock_time(view.cost.core_time / cores), cores,
        view.cost.speed, source_of(view.cost));
}

int run(Options const& options) {
    scenario::Campaign const campaign = scenario::read_campaign(options.campaign_file);
    fs::path const folder =
        options.output.empty() ? fs::path("runs") / campaign.name : fs::path(options.output);
    campaign::Plan const plan = campaign::make_plan(campaign, folder, engine_version(options, folder));
    auto const cases = campaign::survey(plan, campaign::activity_in(plan.folder));
    campaign::Forecast const cost = campaign::forecast(plan, cases);
    PlanView view{campaign, plan, cases, cost};
    for (campaign::CaseOverview const& one : cases) view.known += one.record ? 1 : 0;
    options.json ? print_json(view) : print_text(view);
    return all_well;
}

}  // namespace

void add_plan(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<Options>();
    CLI::App* const command = program.add_subcommand(
        "plan", "List the cases of a campaign, which of them have a result, and what the others will cost");
    add_campaign_file(*command, options->campaign_file);
    add_results_folder(*command, options->output);
    add_engine(*command, options->engine);
    command->add_flag("--json", options->json, "Print JSON for scripts");
    command->footer(
        R"(Prints one line per case: its id, throw number Gamma, machine number K, vibration angle beta and
inclination alpha in degrees, friction coefficient mu, number of grains, packings that have ended and will probably be
needed for the interval that measure.half_width asks for, outcome, and the core time that it still needs. Below, the
cost of the whole campaign is estimated, with the range in which it probably lies. The estimate learns from the cases
that have a result.

Nothing is simulated, and no file is written. Only the version of the engine is read, because the ids of the cases
depend on it.

Exit codes:
    0  all well
    2  the input is wrong
    3  something is missing, for example liggghts

Example:
  vibrotrough plan validation/demo/campaign.toml --output runs/demo)");
    command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vibrotrough::app
