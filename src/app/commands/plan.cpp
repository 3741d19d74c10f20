#include "campaign/state/plan.hpp"

#include "app/commands.hpp"
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

/// The engine that a run would use: asked for, or found, or the one that the folder was planned with. Without
/// any, the cases have no ids and nothing is known of them.
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

struct Seen {
    scenario::Campaign const& campaign;
    campaign::Plan const& plan;
    std::vector<campaign::CaseOverview> const& cases;
    campaign::Forecast const& cost;
    std::size_t known = 0;
};

void print_json(Seen const& seen) {
    Json list = Json::array();
    for (std::size_t i = 0; i < seen.cases.size(); ++i) {
        campaign::CaseOverview const& one = seen.cases[i];
        scenario::Trough const& trough = one.planned->scenario().trough;
        list.push_back({{"case", one.planned->id},
                        {"throw_number", one.planned->prepared->throw_number},
                        {"machine_number", one.planned->prepared->machine_number},
                        {"vibration_angle_deg", scenario::in_degrees(trough.vibration_angle)},
                        {"inclination_deg", scenario::in_degrees(trough.inclination)},
                        {"friction", trough.friction},
                        {"grains", one.planned->scenario().layer.grains},
                        {"packings", one.planned->scenario().measure.packings},
                        {"packings_done", one.packings_done},
                        {"outcome", one.label()},
                        {"core_time_s", seen.cost.cases[i]}});
    }
    Json const json{{"campaign", seen.plan.name},
                    {"cases_total", seen.cases.size()},
                    {"excluded", seen.campaign.excluded},
                    {"known", seen.known},
                    {"core_time_s", seen.cost.core_time},
                    {"speed_grain_steps_per_s", seen.cost.speed},
                    {"speed_is_measured", seen.cost.measured},
                    {"left_aside", campaign::count_left_aside(seen.plan)},
                    {"cases", list}};
    fmt::print("{}\n", json.dump(2));
}

void print_text(Seen const& seen) {
    fmt::print(
        "case          Gamma       K   beta  alpha    mu   grains  packings  outcome       core time\n");
    for (std::size_t i = 0; i < seen.cases.size(); ++i) {
        campaign::CaseOverview const& one = seen.cases[i];
        scenario::Scenario const& scenario = one.planned->scenario();
        fmt::print("{}  {:5.3f}  {:6.3f}  {:5.2f}  {:5.2f}  {:4.2f}  {:7}  {:>4}/{:<3}  {:<12}  {:>9}\n",
                   one.planned->id, one.planned->prepared->throw_number,
                   one.planned->prepared->machine_number,
                   scenario::in_degrees(scenario.trough.vibration_angle),
                   scenario::in_degrees(scenario.trough.inclination), scenario.trough.friction,
                   scenario.layer.grains, one.packings_done, scenario.measure.packings, one.label(),
                   clock_time(seen.cost.cases[i]));
    }
    fmt::print("campaign {}: {} cases, {} known already", seen.plan.name, seen.cases.size(), seen.known);
    if (seen.campaign.excluded > 0) fmt::print(", {} left out by [[exclude]]", seen.campaign.excluded);
    if (std::size_t const aside = campaign::count_left_aside(seen.plan); aside > 0)
        fmt::print(", {} of an earlier version left aside", aside);
    unsigned const cores = std::max(1u, std::thread::hardware_concurrency());
    fmt::print(
        "\nestimated cost: {:.3g} core-hours, {} on {} cores (at {:.2g} grain-steps per second and core, "
        "{})\n",
        seen.cost.core_time / 3600, clock_time(seen.cost.core_time / cores), cores, seen.cost.speed,
        seen.cost.measured ? "from the results that are there" : "a guess before the first result");
}

int run(Options const& options) {
    scenario::Campaign const campaign = scenario::read_campaign(options.campaign_file);
    fs::path const folder =
        options.output.empty() ? fs::path("runs") / campaign.name : fs::path(options.output);
    campaign::Plan const plan = campaign::make_plan(campaign, folder, engine_version(options, folder));
    auto const cases = campaign::survey(plan, campaign::activity_in(plan.folder));
    campaign::Forecast const cost = campaign::forecast(cases);
    Seen seen{campaign, plan, cases, cost};
    for (campaign::CaseOverview const& one : cases) seen.known += one.record ? 1 : 0;
    options.json ? print_json(seen) : print_text(seen);
    return all_well;
}

}  // namespace

void add_plan(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<Options>();
    CLI::App* const command = program.add_subcommand(
        "plan", "Print a campaign's cases, what of them is known already, and what the rest would cost");
    command
        ->add_option("CAMPAIGN.toml", options->campaign_file,
                     "The campaign file (its keys: vibrotrough keys)")
        ->required();
    command->add_option("--output", options->output, "Folder of the campaign's results; default runs/<name>")
        ->type_name("DIR");
    command->add_option("--liggghts", options->engine, "The LIGGGHTS program; default: liggghts on the PATH")
        ->type_name("PATH");
    command->add_flag("--json", options->json, "Print JSON for scripts");
    command->footer(
        "Runs nothing and writes nothing. The engine is asked for its version only, which the cases' ids "
        "depend "
        "on.\n"
        "Exit codes: 0 all well; 2 the input is wrong; 3 something is missing (no liggghts).\n"
        "Example: vibrotrough plan validation/demo/campaign.toml --output runs/demo");
    command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vibrotrough::app
