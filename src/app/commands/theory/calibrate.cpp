#include "app/commands/calibration_options.hpp"
#include "app/commands/command.hpp"
#include "app/commands/theory/options.hpp"
#include "learn/atlas_speed_model.hpp"
#include "learn/layer_errors.hpp"
#include "learn/point_mass_model.hpp"

namespace vibrotrough::app {
namespace {

struct TheoryCalibrateArguments {
    std::string file;
    CalibrationOptions shared;
    std::vector<std::string> fixed;
    std::string model = "point-mass";
    QuantityOptions grains;
};

/// The values of --fix. @throws core::InputError unless each is NAME=NUMBER, and none comes twice
std::map<std::string, double> read_fixed(std::vector<std::string> const& texts) {
    std::map<std::string, double> fixed;
    for (std::string const& text : texts) {
        auto const [name, value] = split_setting("--fix", text, "friction=0.3");
        if (!fixed.emplace(name, read_number("--fix", value, "friction=0.3")).second)
            throw core::InputError(fmt::format("--fix {}: {} is fixed twice; name it once", text, name));
    }
    return fixed;
}

/// @throws core::InputError when a fixed value is far from what the point mass usually has
void check_fixed(std::map<std::string, double> const& fixed) {
    for (auto const& [name, value] : fixed) {
        inference::Bounds const usual =
            std::ranges::find(learn::point_mass_parameters(), name, &learn::FreeParameter::name)->prior;
        if (!(value >= std::min(usual.low, 0.0) && value <= 2 * usual.high))
            throw core::InputError(fmt::format("--fix {}={:g}: must be at most {:g}; write a value within",
                                               name, value, 2 * usual.high));
    }
}

/// Whether it is the model that the layers of the atlas were compared with: without rebounds, and with one
/// friction.
bool is_plastic_mass(std::vector<learn::FreeParameter> const& free,
                     std::map<std::string, double> const& fixed) {
    auto const others = {"static_friction", "landing_friction", "restitution"};
    return std::ranges::none_of(others, [&](std::string const name) {
        return fixed.contains(name) ||
               std::ranges::find(free, name, &learn::FreeParameter::name) != free.end();
    });
}

int run_theory_calibrate(TheoryCalibrateArguments& options) {
    auto const speeds = options.shared.read_speeds(options.file);
    auto const fixed = read_fixed(options.fixed);
    bool const is_atlas = options.model == "atlas";
    if (is_atlas != options.grains.has("--grain-diameter"))
        throw core::InputError(is_atlas ? "--model atlas needs the diameter of the grains; write for example "
                                          "--grain-diameter \"3 mm\""
                                        : "--grain-diameter belongs to --model atlas");
    CalibrationOptions shared = options.shared;
    learn::CalibrationModel model;
    if (is_atlas) {
        shared.free = learn::with_unknown_layer(shared.free, fixed);
        model =
            learn::atlas_speed_model(*options.grains.value("--grain-diameter"), shared.free, fixed, speeds);
    } else {
        model = learn::point_mass_model(shared.free, fixed, speeds);
        check_fixed(fixed);
    }
    auto const parameters =
        shared.parameters(is_atlas ? learn::atlas_parameters() : learn::point_mass_parameters());
    if (is_atlas)
        tell(
            "theory calibrate: asking the atlas tens of thousands of times; this takes about half a "
            "minute\n");
    learn::CalibrationSettings settings = shared.settings();
    if (!is_atlas && !shared.quantities.has("--common-error") && !shared.exact &&
        is_plastic_mass(parameters, fixed))
        settings.layer_errors = learn::point_mass_layer_errors(parameters, fixed, speeds);
    learn::Calibration const calibration = learn::calibrate(model, parameters, speeds, settings);
    print_calibration(shared, calibration, {is_atlas ? "the atlas" : "the point mass"});
    return calibration.converged ? all_well : some_cases_failed;
}

}  // namespace

void add_theory_calibrate(CLI::App& theory, int& exit_code) {
    CLI::App* const command =
        theory.add_subcommand("calibrate", "Find friction and other quantities from measured speeds");
    auto const options = std::make_shared<TheoryCalibrateArguments>();
    command->add_option("file", options->file, "CSV file of measured speeds")->required()->type_name("FILE");
    options->shared.add_to(*command);
    add_repeated(
        *command, "--fix", options->fixed,
        "Value of a quantity that is known, for example restitution=0.1; repeat the option for several",
        "NAME=VALUE");
    command
        ->add_option("--model", options->model,
                     "point-mass, or atlas: the simulated layers of spheres (validation/atlas)")
        ->check(CLI::IsMember({"point-mass", "atlas"}))
        ->capture_default_str();
    options->grains.add_to(*command, {{"--grain-diameter", ", for --model atlas"}});
    command->footer(
        R"(The quantities of the point mass that can be free or fixed are friction, static_friction, landing_friction,
restitution, inclination and vibration_angle (both in degrees). Those of the atlas are friction (on the trough),
grain_friction, rolling_friction, restitution, depth (in diameters), inclination and vibration_angle. What of the grains
and of the depth is not fixed is free as well: it is the same in all measurements, so that the interval of the friction
holds what is not known of it.

The point mass misses layers, and the error of one setting is much like that of the next, so that it looks like another
friction. Its errors at a few hundred layers of the atlas, with these settings, are therefore part of what is expected of
the speeds, before any further discrepancy; not so if it rebounds, or has a static or landing friction of its own. Where
it is exact, as for a block, write --common-error 0; --common-error 0.05 takes an error of that size instead, which is
the same in all settings.

)" + std::string(calibration_help) +
        R"(

Example:
  vibrotrough theory calibrate speeds.csv --free friction,inclination --plot corner.png
  vibrotrough theory calibrate speeds.csv --free friction --model atlas \
      --grain-diameter "3.5 mm" --fix depth=4)");
    command->callback([options, &exit_code] { exit_code = run_theory_calibrate(*options); });
}

}  // namespace vibrotrough::app
