#include "app/commands/calibration_options.hpp"
#include "app/commands/command.hpp"
#include "app/extra_lines.hpp"
#include "app/learning.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "learn/surface_model.hpp"
#include "scenario/reader/campaign_file.hpp"

namespace vibrotrough::app {
namespace {

struct CalibrateArguments {
    std::string campaign, measured;
    Text budget;
    QuantityOptions counts;
    RunOptions running;
    CalibrationOptions shared;
};

/// The folder of the results: given itself, or that of a campaign file.
fs::path folder_of(CalibrateArguments const& options) {
    if (fs::is_directory(options.campaign)) return options.campaign;
    return results_folder(options.running.output, scenario::read_campaign(options.campaign).name);
}

/// A calibration on the surface that the results of a campaign give.
struct OnSurface {
    std::shared_ptr<atlas::Surface const> surface;
    learn::Calibration calibration;
};

OnSurface calibrate_on(campaign::Plan const& plan, scenario::CaseMaker const& maker,
                       CalibrateArguments const& options, std::vector<learn::MeasuredSpeed> const& speeds) {
    learn::CampaignPoints points = learn::campaign_points(plan, maker);
    auto const surface = std::make_shared<atlas::Surface const>(learn::surface_of(points));
    learn::CalibrationModel const model =
        learn::surface_model(surface, maker, options.shared.free, speeds, points.numerics);
    auto const parameters = options.shared.parameters(learn::surface_parameters(points.inputs));
    return {surface, learn::calibrate(model, parameters, speeds, options.shared.settings())};
}

int print(CalibrateArguments const& options, OnSurface const& found) {
    print_calibration(options.shared, found.calibration, {"the simulated layer"});
    for (std::string const& doubt : found.surface->doubts()) tell("surface: {}\n", doubt);
    return found.calibration.converged ? all_well : some_cases_failed;
}

/// The half-width of the surface below which it adds little to the uncertainty of the measurements: half of
/// theirs, in velocity efficiency.
double useful_half_width(std::vector<learn::MeasuredSpeed> const& speeds) {
    double least = 1;
    for (learn::MeasuredSpeed const& m : speeds) {
        theory::Drive const drive{m.frequency, m.amplitude, m.vibration_angle.value_or(0), 0};
        least = std::min(least, 0.5 * 1.96 * m.uncertainty / drive.trough_speed());
    }
    return std::clamp(least, 1e-4, 1.0);
}

/// Simulates where the posterior lies until the surface is precise there, or the budget is spent.
int refine(CalibrateArguments const& options, std::vector<learn::MeasuredSpeed> const& speeds,
           RunOptions const& running, double budget) {
    ReadyCampaign ready = prepare_run(running);
    if (ready.is_interrupted) return interrupted;
    scenario::CaseMaker const maker(running.campaign_file);
    learn::LearnGoal const goal{useful_half_width(speeds), budget, usual_batch(running.jobs, ready.plan)};
    auto wanted = learn::read_wanted_half_widths(ready.plan.folder);
    keep_known_cases(ready.plan, maker, wanted);
    while (true) {
        if (!simulate(running, ready, wanted)) return interrupted;
        OnSurface const found = calibrate_on(ready.plan, maker, options, speeds);
        learn::Learner learner(ready.plan, maker, goal);
        learner.concentrate_on(
            learn::posterior_places(found.surface->inputs(), options.shared.free, found.calibration, speeds));
        learn::LearnStatus const status = learner.look();
        if (!running.quiet)
            tell(
                "calibrate: {} cases; half-width of the surface where the posterior lies: {:.4f} (useful: "
                "{:.4f}); {:.3g} of {:.3g} core-hours spent\n",
                status.cases, status.certainty.at_worst.half_width, goal.half_width, status.core_time / 3600,
                budget / 3600);
        bool const is_precise = status.certainty.at_worst.half_width <= goal.half_width;
        auto const steps = is_precise ? std::vector<learn::LearnStep>{} : learner.choose();
        if (steps.empty() || !take_steps(steps, ready.plan, wanted)) return print(options, found);
    }
}

int run_calibrate(CalibrateArguments& options) {
    auto const speeds = options.shared.read_speeds(options.measured);
    if (options.budget && fs::is_directory(options.campaign))
        throw core::InputError("--budget: simulates, and needs the campaign file instead of its folder");
    fs::path const folder = folder_of(options);
    scenario::CaseMaker const maker(options.budget ? fs::path(options.campaign) : folder / "campaign.toml");
    for (std::string& name : options.shared.free) name = maker.full_key(name);
    if (!options.budget)
        return print(options, calibrate_on(campaign::open_plan(folder), maker, options, speeds));
    RunOptions running = options.running;
    running.campaign_file = options.campaign;
    running.output = folder.string();
    running.jobs = static_cast<int>(options.counts.value("--jobs").value_or(running.jobs));
    return refine(options, speeds, running, read_core_time(*options.budget));
}

}  // namespace

void add_calibrate(CLI::App& program, int& exit_code) {
    CLI::App* const command =
        program.add_subcommand("calibrate", "Find inputs of a simulated layer from measured speeds");
    auto const options = std::make_shared<CalibrateArguments>();
    command
        ->add_option("campaign", options->campaign, "Folder of a campaign that was run, or its campaign file")
        ->required()
        ->type_name("DIR|CAMPAIGN.toml");
    add_text(*command, "--output", options->running.output,
             "Folder of the results of CAMPAIGN.toml; default: runs/NAME", "DIR");
    command->add_option("--measured", options->measured, "CSV file of measured speeds")
        ->required()
        ->type_name("FILE");
    options->shared.add_to(*command);
    add_text(*command, "--budget", options->budget,
             "Core time, for example \"1 core-hours\": simulate further cases where the posterior lies "
             "until it is spent, or the surface is twice as precise there as the measurements; needs "
             "CAMPAIGN.toml with a [domain]",
             "TIME");
    add_engine(*command, options->running.engine);
    options->counts.add_to(*command, {{"--jobs", ", with --budget"}});
    command->add_flag("--quiet", options->running.quiet, "Show no progress of the simulations");
    command->add_flag("--accept-findings", options->running.accept_findings,
                      "Simulate although the check of the campaign found errors");
    add_allow_extra(*command, options->running.allow_extra);
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
  vibrotrough calibrate runs/krakow --measured speeds.csv --free trough.friction
  vibrotrough calibrate domain.toml --measured speeds.csv --free trough.friction \
      --budget "1 core-hours")");
    command->callback([options, &exit_code] { exit_code = run_calibrate(*options); });
}

}  // namespace vibrotrough::app
