#include "app/commands/design_options.hpp"

#include "app/commands/calibration_options.hpp"
#include "app/commands/command.hpp"
#include "app/learning.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "learn/atlas_design_model.hpp"
#include "learn/notes.hpp"
#include "learn/surface_design_model.hpp"

namespace vibrotrough::app {
namespace {

std::map<std::string, learn::Objective> const objectives{
    {"fastest", learn::Objective::fastest},
    {"gentlest-landing", learn::Objective::gentlest_landing},
    {"least-machine-number", learn::Objective::least_machine_number},
    {"least-power", learn::Objective::least_power}};

learn::SettingErrors read_errors(DesignOptions const& o, double bulk_density) {
    learn::SettingErrors errors{.bulk_density = bulk_density};
    errors.amplitude = o.quantities.value("--stroke-uncertainty").value_or(2 * errors.amplitude) / 2;
    errors.vibration_angle = o.quantities.value("--angle-uncertainty").value_or(errors.vibration_angle);
    return errors;
}

/// @throws core::InputError when the stroke cannot follow from the exciter
void check_exciter(DesignOptions const& o, learn::DesignTask const& task) {
    o.quantities.required("--length");
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
    for (auto const& [key, content] : read_place(places, maker)) {
        if (auto const* number = std::get_if<double>(&content)) {
            given.numbers[key] = *number;
        } else {
            given.words[key] = content;
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
                                       quantities.value("--model-discrepancy").value_or(0));
}

void DesignOptions::add_to(CLI::App& command) {
    add_material(command);
    add_limits(command);
    exciter.add_to(command);
    command.add_option("--objective", objective, "What the machine is to be best at")
        ->check(CLI::IsMember({"fastest", "gentlest-landing", "least-machine-number", "least-power"}))
        ->capture_default_str();
    quantities.add_to(command, {{"--confidence"}, {"--model-discrepancy"}});
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
    add_text(command, "--surface", surface,
             "Folder of a campaign, whose cases are the model 'surface' (see 'vibrotrough predict')", "DIR");
    add_repeated(command, "--at", places,
                 "Value of another key that this campaign varies, for example rolling_friction=0.05; "
                 "repeat the option for several",
                 "KEY=VALUE");
}

void DesignOptions::add_material(CLI::App& command) {
    std::string const group = "The task";
    command
        .add_option("--mass-flow", mass_flow,
                    "To be reached, for example \"12 t/h\", or by volume \"20 m3/h\"")
        ->group(group);
    quantities.add_to(
        command,
        {{"--bulk-density", ", such as \"600 kg/m3\", \"600+-30 kg/m3\" or \"550 to 650 kg/m3\"",
          "Of the material"},
         {"--surge"},
         {"--width", ", for example \"300 mm\"", "Of the trough"},
         {"--length"},
         {"--layer-depth"},
         {"--friction",
          ": 0.3, with its standard uncertainty 0.3+-0.03, or anything within a range, \"0.25 to 0.35\""},
         {"--friction-uncertainty"},
         {"--grain-diameter", "",
          "Of the grains: for the depth of the layer in grains, for the atlas, and for the campaign, whose "
          "default is \"3 mm\""},
         {"--rolling-friction", "",
          "Of the grains, for the atlas, the rolling-layer law and layers that are simulated, written like "
          "--friction; default: not known, anything between 0 and 0.2, and 0.1 in the campaign"},
         {"--grain-friction", "",
          "Friction between the grains, for the atlas, written like --friction; default: not known, anything "
          "between 0.3 and 0.8"}},
        group);
    material.add_to(command, group);
    command
        .add_option("--posterior", posterior,
                    "In place of the friction: the file that 'vibrotrough theory calibrate --posterior FILE' "
                    "wrote, or what its --json printed")
        ->group(group);
}

/// The limits of a kind of drive, where no others are asked for.
void DesignOptions::keep_to_drive(learn::DesignTask& task) const {
    task.drive_kinds = ExciterOptions::drive_kinds();
    auto const kind = exciter.drive();
    if (!kind) return;
    task.drive_kind = *kind;
    if (!drive.stroke && !drive.amplitude)
        task.space.amplitude = {kind->stroke.low / 2, kind->stroke.high / 2};
    if (!drive.rpm && !drive.frequency && !drive.poles)
        task.space.frequency = {kind->rpm.low / 60, kind->rpm.high / 60};
    if (!drive.machine_number) task.space.max_machine_number = kind->machine_number;
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
    add("--mains", drive.mains, option_row("--mains").meaning.c_str());
    add("--slip", drive.slip, option_row("--slip").meaning.c_str());
    add("--vibration-angle", drive.vibration_angle, "Range of beta; default: \"5 deg to 60 deg\"");
    add("--inclination", drive.inclination, "Range of alpha, uphill positive; default: level");
    add("--machine-number", drive.machine_number,
        "Largest machine number K = omega^2 r / g that the structure bears; default: 5");
    add("--throw-number", drive.throw_number,
        "Largest throw number Gamma; default: 3.29, at which a flight takes one cycle");
    quantities.add_to(command, {{"--stroke-uncertainty"}, {"--angle-uncertainty"}, {"--landing-speed"}},
                      "The machine's limits");
}

learn::KnownFriction DesignOptions::read_friction(std::string& calibrated_model) const {
    for (char const* const other : {"--friction", "--friction-uncertainty"})
        refuse_both("--posterior", posterior, other, quantities.text(other));
    if (posterior) {
        core::TextFile const file = core::read_text_file(*posterior);
        auto const [read, model] = learn::read_posterior(file.content, *posterior);
        calibrated_model = model;
        return read;
    }
    required("--friction", quantities.text("--friction"), "0.3");
    learn::Uncertain known = *quantities.uncertain("--friction");
    constexpr double least = 0.01;
    if ((known.shape == learn::Shape::uniform ? known.low() : known.mean) < least)
        throw core::InputError(fmt::format("--friction {}: must be at least {}; write for example 0.3",
                                           *quantities.text("--friction"), least));
    if (auto const sd = quantities.value("--friction-uncertainty")) {
        if (known.sd > 0) quantities.refuse_both("--friction", "--friction-uncertainty");
        known.sd = *sd;
    }
    return known.shape == learn::Shape::uniform ? learn::friction_between(known.low(), known.high())
                                                : learn::normal_friction(known.mean, known.sd);
}

learn::KnownGrains DesignOptions::read_grains() const {
    return {quantities.value("--grain-diameter"), quantities.uncertain("--rolling-friction"),
            quantities.uncertain("--grain-friction")};
}

bool DesignOptions::material_chooses_model() const {
    return models.empty() && surface.empty() && !posterior && quantities.has("--grain-diameter");
}

/// The atlas decides for spheres that roll, the point mass for grains that do not; of those between them
/// nothing is known. The other models stand beside it.
void DesignOptions::choose_models(learn::DesignTask& task) const {
    auto const missed = quantities.value("--model-discrepancy");
    auto const rolling = quantities.uncertain("--rolling-friction");
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
    std::optional<double> const missed = quantities.value("--model-discrepancy");
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
            all.push_back(learn::rolling_layer_design_model(quantities.uncertain("--rolling-friction"),
                                                            missed, known.median));
        else if (name == "atlas" && !quantities.value("--grain-diameter"))
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
    learn::DesignTask task{};
    ReadSpace const read = read_drive_space(drive);
    task.space = read.space;
    task.frequencies = read.frequencies;
    task.amplitudes = read.amplitudes;
    keep_to_drive(task);
    task.tells_amplitude = drive.amplitude.has_value();
    task.tells_frequency = drive.frequency.has_value();
    std::string const flow = required("--mass-flow", mass_flow, "\"12 t/h\"");
    quantities.required("--width");
    required("--bulk-density", quantities.text("--bulk-density"), "\"600 kg/m3\"");
    auto const density = *quantities.uncertain("--bulk-density");
    task.bulk_density = density.mean;
    // A trough carries the same volume whatever the material weighs.
    task.errors = read_errors(*this, is_volume_flow(flow) ? 0 : density.sd);
    task.mass_flow = read_mass_flow("--mass-flow", flow, task.bulk_density);
    task.surge = quantities.value("--surge").value_or(1);
    task.mass_flow *= task.surge;
    task.material = material.told();
    task.width = *quantities.value("--width");
    task.length = quantities.value("--length").value_or(task.length);
    task.machine = exciter.machine();
    if (task.machine) check_exciter(*this, task);
    task.landing_speed = quantities.value("--landing-speed");
    task.confidence = quantities.value("--confidence").value_or(task.confidence);
    if (auto const& depth = quantities.text("--layer-depth"))
        task.depth = read_option_range("--layer-depth", *depth);
    task.grain_diameter = quantities.value("--grain-diameter");
    if (auto const rolling = quantities.uncertain("--rolling-friction"))
        task.rolling_friction = rolling->mean;
    if (auto const between = quantities.uncertain("--grain-friction")) task.grain_friction = between->mean;
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
    if (auto const& why = material.why_unknown()) {
        task.unknown_material = *why;
        task.stand_in = task.models.front();
    }
    task.objective = objectives.at(objective);
    // What a calibration says of a model's error holds for the model that was calibrated.
    if (!task.friction.discrepancies.empty() && !quantities.has("--model-discrepancy")) {
        for (learn::DesignModel& model : task.models)
            model.uses_calibrated_discrepancy = model.name == calibrated_model;
    }
    return task;
}

}  // namespace vibrotrough::app
