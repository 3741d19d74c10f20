#include "app/commands.hpp"
#include "app/commands/calibration_options.hpp"
#include "app/exit_code.hpp"
#include "app/standard_streams.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "learn/calibration_report.hpp"
#include "learn/surface_model.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

namespace fs = std::filesystem;

struct Options {
    std::string campaign, output, measured;
    CalibrationOptions shared;
};

/// The folder of the results: given itself, or that of a campaign file.
fs::path folder_of(Options const& options) {
    if (fs::is_directory(options.campaign)) return options.campaign;
    scenario::Campaign const campaign = scenario::read_campaign(options.campaign);
    return options.output.empty() ? fs::path("runs") / campaign.name : fs::path(options.output);
}

int run(Options& options) {
    fs::path const folder = folder_of(options);
    campaign::Plan const plan = campaign::open_plan(folder);
    scenario::CaseMaker const maker(folder / "campaign.toml");
    core::TextFile const table = core::read_text_file(options.measured);
    auto const speeds =
        learn::read_speeds(table.content, options.measured, options.shared.relative_uncertainty());
    for (std::string& name : options.shared.free) name = maker.full_key(name);
    learn::CampaignPoints points = learn::campaign_points(plan, maker);
    auto const surface = std::make_shared<learn::Surface const>(points.inputs, points.points);
    learn::SpeedModel const model = learn::surface_model(surface, maker, options.shared.free, speeds);
    auto const parameters = options.shared.parameters(learn::surface_parameters(points.inputs));
    auto const calibration = learn::calibrate(model, parameters, speeds, options.shared.settings());
    print_calibration(options.shared, calibration, {"the simulated layer"});
    for (std::string const& doubt : surface->doubts()) tell("surface: {}\n", doubt);
    return calibration.converged ? all_well : some_cases_failed;
}

}  // namespace

void add_calibrate(CLI::App& program, int& exit_code) {
    CLI::App* const command =
        program.add_subcommand("calibrate", "Find inputs of a simulated layer from measured speeds");
    auto const options = std::make_shared<Options>();
    command
        ->add_option("campaign", options->campaign, "Folder of a campaign that was run, or its campaign file")
        ->required()
        ->type_name("DIR|CAMPAIGN.toml");
    command
        ->add_option("--output", options->output,
                     "Folder of the results of CAMPAIGN.toml; default: runs/NAME")
        ->type_name("DIR");
    command->add_option("--measured", options->measured, "CSV file of measured speeds")
        ->required()
        ->type_name("FILE");
    options->shared.add_to(*command);
    command->footer(
        "The cases of the campaign give a surface of the velocity efficiency (see 'vibrotrough predict "
        "--help'). What the "
        "measurements say of the machine chooses the place on it; the free quantities are its other inputs, "
        "for example "
        "trough.friction and grains.rolling_friction, within the range that was simulated. The uncertainty "
        "of the surface is part of "
        "that of the result.\n\n" +
        std::string(calibration_help) +
        R"(

Example:
  vibrotrough calibrate runs/krakow --measured speeds.csv --free trough.friction)");
    command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vibrotrough::app
