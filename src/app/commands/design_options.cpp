#include "app/commands/design_options.hpp"

#include "app/commands/calibration_options.hpp"
#include "app/commands/uncertain_options.hpp"
#include "app/learning.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "learn/atlas_design_model.hpp"
#include "learn/notes.hpp"
#include "learn/surface_design_model.hpp"
#include "scenario/reader/written_campaign.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

std::map<std::string, learn::Objective> const objectives{
    {"fastest", learn::Objective::fastest},
    {"gentlest-landing", learn::Objective::gentlest_landing},
    {"least-machine-number", learn::Objective::least_machine_number},
    {"least-power", learn::Objective::least_power}};

learn::SettingErrors read_errors(DesignOptions const& o, double bulk_density) {
    learn::SettingErrors errors{.bulk_density = bulk_density};
    if (o.stroke_uncertainty)
        errors.amplitude =
            read_positive_quantity("--stroke-uncertainty", *o.stroke_uncertainty, "m", "0.2 mm") / 2;
    if (o.angle_uncertainty)
        errors.vibration_angle = read_angle("--angle-uncertainty", *o.angle_uncertainty, "0.5 deg", 0, 20);
    return errors;
}

/// @throws core::InputError when the stroke cannot follow from the exciter
void check_exciter(DesignOptions const& o, learn::DesignTask const& task) {
    required("--length", o.length, "\"3 m\"");
    if (!task.machine->exciter) return;
    refuse_both("--exciter", o.exciter.exciter(), "--stroke", o.drive.stroke);
    refuse_both("--exciter", o.exciter.exciter(), "--amplitude", o.drive.amplitude);
    bool const is_one_speed =
        task.frequencies.empty() && task.space.frequency.low == task.space.frequency.high;
    if (task.machine->spring > 0 && !is_one_speed)
        throw core::InputError(
            "--spring: with springs the stroke depends on the speed of the drive; write one, for example "
            "--rpm 960, or one number of --poles");
}

/// Values of the surface's inputs that the user gave: numbers by whole key, and words.
struct GivenPlace {
    std::map<std::string, double> numbers;
    std::map<std::string, scenario::Content> words;
};

GivenPlace read_places(std::vector<std::string> const& places, scenario::CaseMaker const& maker) {
    GivenPlace given;
    for (std::string const& text : places) {
        auto const [name, value] = split_setting("--at", text, "rolling_friction=0.05");
        try {
            std::string const key = maker.full_key(name);
            scenario::Content const content = maker.read_value(key, value);
            if (auto const* number = std::get_if<double>(&content)) {
                given.numbers[key] = *number;
            } else {
                given.words[key] = content;
            }
        } catch (core::InputError const& error) {
            throw core::InputError(fmt::format("--at {}: {}", text, error.what()));
        }
    }
    return given;
}

}  // namespace

learn::DesignModel DesignOptions::read_surface(learn::KnownFriction const& known) const {
    campaign::Plan const plan = campaign::open_plan(surface);
    scenario::CaseMaker const maker(std::filesystem::path(surface) / "campaign.toml");
    GivenPlace const given = read_places(places, maker);
    learn::CampaignPoints points = learn::campaign_points(plan, maker, given.words);
    tell_of_other_layers(points.other_layers);
    return learn::surface_design_model(std::make_shared<atlas::Surface const>(learn::surface_of(points)),
                                       learn::CampaignTrend(maker, points.inputs, given.words), given.numbers,
                                       {known, read_grains()}, points.numerics,
                                       read_discrepancy().value_or(0));
}

void DesignOptions::add_to(CLI::App& command) {
    add_material(command);
    add_limits(command);
    exciter.add_to(command);
    command.add_option("--objective", objective, "What the machine is to be best at")
        ->check(CLI::IsMember({"fastest", "gentlest-landing", "least-machine-number", "least-power"}))
        ->capture_default_str();
    command.add_option("--confidence", confidence,
                       "Probability with which the mass flow is to be reached; default: 0.95");
    command
        .add_option("--model", models,
                    "By which model: point-mass, rolling-layer, atlas, surface, or several, separated by "
                    "commas, which must then all reach the mass flow; default: with --grain-diameter the "
                    "atlas, or the "
                    "point mass for grains that do not roll (rolling friction of 0.5 or more)")
        ->delimiter(',')
        ->expected(1)
        ->type_name("MODEL[,MODEL...]")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->check(CLI::IsMember({"point-mass", "rolling-layer", "atlas", "surface"}));
    command
        .add_option("--surface", surface,
                    "Folder of a campaign, whose cases are the model 'surface' (see 'vibrotrough predict')")
        ->type_name("DIR");
    command
        .add_option("--at", places,
                    "Value of another key that this campaign varies, for example rolling_friction=0.05; "
                    "repeat the option for several")
        ->type_name("KEY=VALUE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command.add_option(
        "--model-discrepancy", discrepancy,
        "Standard deviation of what every model misses, in velocity efficiency; default: what simulated "
        "layers "
        "say at the throw number, slope and depth (validation/model_errors), for the calibrated model what "
        "--posterior says, and for a surface its own uncertainty alone");
}

void DesignOptions::add_material(CLI::App& command) {
    auto const add = [&](char const* name, Text& text, char const* help) {
        command.add_option(name, text, help)->group("The task");
    };
    add("--mass-flow", mass_flow, "To be reached, for example \"12 t/h\", or by volume \"20 m3/h\"");
    add("--bulk-density", bulk_density,
        "Of the material, for example \"600 kg/m3\", \"600+-30 kg/m3\" or \"550 to 650 kg/m3\"");
    add("--width", width, "Of the trough, for example \"300 mm\"");
    add("--length", length, "Of the trough, for power and time, for example \"3 m\"");
    add("--layer-depth", depth, "Range of the layer's depth; default: \"2 mm to 100 mm\"");
    add("--friction", friction,
        "mu, friction coefficient of the material on the trough: 0.3, with its standard uncertainty "
        "0.3+-0.03, "
        "or anything within a range, \"0.25 to 0.35\"");
    add("--friction-uncertainty", friction_uncertainty,
        "Its standard uncertainty (one standard deviation), instead of +-; default: 0");
    add("--grain-diameter", grain_diameter,
        "Of the grains: for the depth of the layer in grains, for the atlas, and for the campaign, whose "
        "default is \"3 mm\"");
    add("--rolling-friction", rolling_friction,
        "Of the grains, for the atlas, the rolling-layer law and layers that are simulated, written like "
        "--friction; default: not known, anything between 0 and 0.2, and 0.1 in the campaign");
    add("--grain-friction", grain_friction,
        "Friction between the grains, for the atlas, written like --friction; default: not known, anything "
        "between 0.3 and 0.8");
    add("--posterior", posterior,
        "In place of both: the file that 'vibrotrough theory calibrate --posterior FILE' wrote, or what its "
        "--json printed");
}

void DesignOptions::add_limits(CLI::App& command) {
    auto const add = [&](char const* name, Text& text, char const* help) {
        command.add_option(name, text, help)->group("The machine's limits");
    };
    add("--stroke", drive.stroke,
        "Range of 2 r, or the strokes that can be had, such as \"6,8,10 mm\", of which the best is chosen; "
        "default: \"1 mm to 30 mm\"");
    add("--amplitude", drive.amplitude, "Range of r, half the stroke, instead of --stroke");
    add("--rpm", drive.rpm,
        "Range of the drive's turns per minute, or the speeds that can be had, such as 960,1450,2900, of "
        "which "
        "the best is chosen; default: \"300 to 3600\"");
    add("--frequency", drive.frequency, "The same as a frequency, for example \"5 Hz to 25 Hz\"");
    add("--poles", drive.poles,
        "Instead of --rpm, poles of the motors that can be had, such as 4,6,8: 120 f / poles (1 - slip) "
        "turns per minute");
    add("--mains", drive.mains, "f, frequency of the mains for --poles, in Hz: 50, or 60 as in America");
    add("--slip", drive.slip,
        "Slip of these motors, by which fraction they are slower than their field, such as 0.03; default: 0");
    add("--vibration-angle", drive.vibration_angle, "Range of beta; default: \"5 deg to 60 deg\"");
    add("--inclination", drive.inclination, "Range of alpha, uphill positive; default: level");
    add("--stroke-uncertainty", stroke_uncertainty,
        "Standard uncertainty of the stroke as it is set, for example \"0.2 mm\"; default: exact");
    add("--angle-uncertainty", angle_uncertainty,
        "Standard uncertainty of the vibration angle as it is set, for example \"0.5 deg\"; default: exact");
    add("--machine-number", drive.machine_number,
        "Largest machine number K = omega^2 r / g that the structure bears; default: 5");
    add("--throw-number", drive.throw_number,
        "Largest throw number Gamma; default: 3.29, at which a flight takes one cycle");
    add("--landing-speed", landing_speed,
        "Largest speed of the material relative to the trough at an impact, for example \"0.3 m/s\"");
}

learn::KnownFriction DesignOptions::read_friction(std::string& calibrated_model) const {
    refuse_both("--posterior", posterior, "--friction", friction);
    refuse_both("--posterior", posterior, "--friction-uncertainty", friction_uncertainty);
    if (posterior) {
        core::TextFile const file = core::read_text_file(*posterior);
        auto const [read, model] = learn::read_posterior(file.content, *posterior);
        calibrated_model = model;
        return read;
    }
    learn::Uncertain known =
        read_uncertain_number("--friction", required("--friction", friction, "0.3"), "0.3", 0.01, 10);
    if (friction_uncertainty) {
        if (known.sd > 0) refuse_both("--friction", friction, "--friction-uncertainty", friction_uncertainty);
        known.sd = read_number_within("--friction-uncertainty", *friction_uncertainty, "0.03", 0, 1);
    }
    return known.shape == learn::Shape::uniform ? learn::friction_between(known.low(), known.high())
                                                : learn::normal_friction(known.mean, known.sd);
}

std::optional<learn::Uncertain> DesignOptions::read_rolling_friction() const {
    if (!rolling_friction) return {};
    return read_uncertain_number("--rolling-friction", *rolling_friction, "0.05", 0, 1);
}

std::optional<learn::Uncertain> DesignOptions::read_grain_friction() const {
    if (!grain_friction) return {};
    return read_uncertain_number("--grain-friction", *grain_friction, "0.5", 0, 10);
}

learn::KnownGrains DesignOptions::read_grains() const {
    std::optional<double> diameter;
    if (grain_diameter) diameter = read_positive_quantity("--grain-diameter", *grain_diameter, "m", "3 mm");
    return {diameter, read_rolling_friction(), read_grain_friction()};
}

std::optional<double> DesignOptions::read_discrepancy() const {
    if (!discrepancy) return {};
    return read_number_within("--model-discrepancy", *discrepancy, "0.05", 0, 1);
}

bool DesignOptions::material_chooses_model() const {
    return models.empty() && surface.empty() && !posterior && grain_diameter;
}

/// The atlas decides for spheres that roll, the point mass for grains that do not; of those between them
/// nothing is known. The other models stand beside it.
void DesignOptions::choose_models(learn::DesignTask& task) const {
    auto const missed = read_discrepancy();
    auto const rolling = read_rolling_friction();
    auto const point_mass = learn::point_mass_design_model(missed);
    auto const law = learn::rolling_layer_design_model(rolling, missed, task.friction.median);
    if (rolling && rolling->mean >= learn::least_friction_without_rolling) {
        task.models = {point_mass};
        task.beside = {law};
        return;
    }
    task.beside = {law, point_mass};
    task.stand_in = point_mass;
    try {
        task.models = {learn::atlas_design_model(read_grains(), missed.value_or(0), task.friction.median)};
    } catch (core::InputError const& error) {
        task.unknown_material = error.what();
        task.models = {point_mass};
    }
}

std::vector<learn::DesignModel> DesignOptions::read_models(learn::KnownFriction const& known) const {
    std::optional<double> const missed = read_discrepancy();
    auto names = models;
    if (names.empty()) names.emplace_back(surface.empty() ? "point-mass" : "surface");
    bool const has_surface = std::ranges::find(names, "surface") != names.end();
    if (has_surface && surface.empty())
        throw core::InputError("--model surface: needs the folder of a campaign; write --surface DIR");
    if (!has_surface && !surface.empty())
        throw core::InputError("--surface: is not among the models; write --model surface");
    if (surface.empty() && !places.empty())
        throw core::InputError("--at: belongs to a surface; write --surface DIR, or leave it out");
    std::vector<learn::DesignModel> all;
    for (std::string const& name : names) {
        if (name == "point-mass")
            all.push_back(learn::point_mass_design_model(missed));
        else if (name == "rolling-layer")
            all.push_back(learn::rolling_layer_design_model(read_rolling_friction(), missed, known.median));
        else if (name == "atlas" && !grain_diameter)
            throw core::InputError(
                "--model atlas needs the size of the grains; write --grain-diameter \"3 mm\"");
        else if (name == "atlas")
            all.push_back(learn::atlas_design_model(read_grains(), missed.value_or(0), known.median));
        else
            all.push_back(read_surface(known));
    }
    return all;
}

learn::DesignTask DesignOptions::task() const {
    auto const quantity = [](char const* option, Text const& text, char const* unit, char const* example) {
        return read_positive_quantity(option, required(option, text, fmt::format("\"{}\"", example)), unit,
                                      example);
    };
    learn::DesignTask task{};
    ReadSpace const read = read_drive_space(drive);
    task.space = read.space;
    task.frequencies = read.frequencies;
    task.amplitudes = read.amplitudes;
    task.tells_amplitude = drive.amplitude.has_value();
    task.tells_frequency = drive.frequency.has_value();
    std::string const flow = required("--mass-flow", mass_flow, "\"12 t/h\"");
    auto const density = read_uncertain_quantity(
        "--bulk-density", required("--bulk-density", bulk_density, "\"600 kg/m3\""), "kg/m3", "600 kg/m3");
    task.bulk_density = density.mean;
    task.errors = read_errors(*this, density.sd);
    task.mass_flow = read_mass_flow("--mass-flow", flow, task.bulk_density);
    task.width = quantity("--width", width, "m", "300 mm");
    if (length) task.length = quantity("--length", length, "m", "3 m");
    task.machine = exciter.machine();
    if (task.machine) check_exciter(*this, task);
    if (landing_speed) task.landing_speed = quantity("--landing-speed", landing_speed, "m/s", "0.3 m/s");
    if (confidence) task.confidence = read_number_within("--confidence", *confidence, "0.95", 0.5, 0.999);
    if (depth)
        task.depth = read_range("--layer-depth", *depth, "5 mm to 60 mm", [](std::string const& text) {
            return read_positive_quantity("--layer-depth", text, "m", "5 mm to 60 mm");
        });
    if (grain_diameter)
        task.grain_diameter = read_positive_quantity("--grain-diameter", *grain_diameter, "m", "3 mm");
    if (rolling_friction) task.rolling_friction = read_rolling_friction()->mean;
    if (grain_friction) task.grain_friction = read_grain_friction()->mean;
    std::string calibrated_model;
    task.friction = read_friction(calibrated_model);
    tell_unusual(drive, task.space, task.friction.median, task.bulk_density);
    std::string const why_so_low = task.friction.sd > 0
                                       ? fmt::format(" ({:.3g} less three standard deviations of {:.3g})",
                                                     task.friction.median, task.friction.sd)
                                       : "";
    check_slope(drive, task.space, task.friction.low, why_so_low);
    if (material_chooses_model())
        choose_models(task);
    else
        task.models = read_models(task.friction);
    task.objective = objectives.at(objective);
    // What a calibration says of a model's error holds for the model that was calibrated.
    if (!task.friction.discrepancies.empty() && !discrepancy) {
        for (learn::DesignModel& model : task.models)
            model.uses_calibrated_discrepancy = model.name == calibrated_model;
    }
    return task;
}

}  // namespace vibrotrough::app
