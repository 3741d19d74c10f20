#include "theory/design.hpp"

#include "app/commands.hpp"
#include "app/commands/theory/drive_space.hpp"
#include "app/exit_code.hpp"
#include "core/error.hpp"
#include "theory/tested_range.hpp"

#include <cmath>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::app {
namespace {

struct TheoryDesignArguments {
    DriveTexts drive;
    Text friction, mass_flow, bulk_density, layer_height, layer_width, gravity;
    RollingOption rolling;
    bool json = false;
};

theory::DesignLimits read(TheoryDesignArguments const& o) {
    theory::DesignLimits l{};
    l.friction =
        read_number_within("--friction", required("--friction", o.friction, "0.3"), "0.3", 1e-6, 1000);
    theory::DriveSpace const space = read_drive_space(o.drive).space;
    l.frequency = space.frequency;
    l.amplitude = space.amplitude;
    l.vibration_angle = space.vibration_angle;
    l.inclination = space.inclination;
    l.max_machine_number = space.max_machine_number;
    l.max_throw_number = space.max_throw_number;
    auto const set = [](double& value, char const* option, Text const& text, char const* unit,
                        char const* example) {
        if (text) value = read_positive_quantity(option, *text, unit, example);
    };
    set(l.bulk_density, "--bulk-density", o.bulk_density, "kg/m3", "800 kg/m3");
    if (o.mass_flow) {
        l.min_mass_flow = read_mass_flow("--mass-flow", *o.mass_flow,
                                         o.bulk_density ? std::optional(l.bulk_density) : std::nullopt);
    }
    set(l.layer_height, "--layer-height", o.layer_height, "m", "20 mm");
    set(l.layer_width, "--layer-width", o.layer_width, "m", "200 mm");
    set(l.gravity, "--gravity", o.gravity, "m/s2", "9.81 m/s2");
    if (o.mass_flow && !(o.bulk_density && o.layer_height && o.layer_width)) {
        throw core::InputError(
            fmt::format("--mass-flow {}: also needs --bulk-density, --layer-height and "
                        "--layer-width; write them",
                        *o.mass_flow));
    }
    tell_unusual(o.drive, l.space(), l.friction,
                 o.bulk_density ? std::optional(l.bulk_density) : std::nullopt);
    check_slope(o.drive, l.space(), l.friction);
    return l;
}

nlohmann::ordered_json as_json(theory::Design const& d) {
    return {{"feasible", d.feasible},
            {"conveying_speed_m_per_s", d.conveying_speed},
            {"mass_flow_kg_per_s", d.mass_flow > 0 ? nlohmann::ordered_json(d.mass_flow) : nullptr},
            {"mass_flow_t_per_h", d.mass_flow > 0 ? nlohmann::ordered_json(3.6 * d.mass_flow) : nullptr},
            {"frequency_hz", d.frequency},
            {"turns_per_minute", 60 * d.frequency},
            {"amplitude_m", d.amplitude},
            {"stroke_mm", 2e3 * d.amplitude},
            {"vibration_angle_deg", d.vibration_angle / degree},
            {"inclination_deg", d.inclination / degree},
            {"throw_number", d.throw_number},
            {"machine_number", d.machine_number},
            {"velocity_efficiency", d.velocity_efficiency},
            {"mode", d.mode},
            {"active_limits", d.active_limits}};
}

void run_theory_design(TheoryDesignArguments const& options) {
    theory::DesignLimits limits = read(options);
    limits.rolling = options.rolling.law();
    theory::Design d;
    try {
        d = theory::fastest_design(limits);
    } catch (std::invalid_argument const& error) {
        throw core::InputError(fmt::format("no machine fits: {}; widen the limits", error.what()));
    }
    auto json = as_json(d);
    for (auto const& s : theory::sensitivities_at(d, limits)) {
        json["sensitivity"][std::string(theory::name_of(s.input))] = s.derivative;
    }
    theory::PointMass const point{d.throw_number, std::tan(d.vibration_angle), std::tan(d.inclination),
                                  limits.friction};
    if (auto const why = theory::outside_tested_range(point);
        limits.rolling && why && !options.rolling.accepts_untested())
        throw core::InputError(*why + "; widen the limits, or accept that with --accept-untested");
    if (options.json) {
        fmt::print("{}\n", json.dump(2));
        return;
    }
    if (!d.feasible) fmt::print("no machine reaches the requested mass flow; this is the fastest one\n");
    fmt::print("conveying speed      {:.6g} m/s\n", d.conveying_speed);
    if (d.mass_flow > 0)
        fmt::print("mass flow            {:.6g} kg/s = {:.6g} t/h\n", d.mass_flow, 3.6 * d.mass_flow);
    fmt::print("frequency            {:.6g} Hz = {:.6g} 1/min\n", d.frequency, 60 * d.frequency);
    fmt::print("amplitude            {:.6g} mm (stroke {:.6g} mm)\n", 1e3 * d.amplitude, 2e3 * d.amplitude);
    fmt::print("vibration angle      {:.6g} deg\ninclination          {:.6g} deg\n",
               d.vibration_angle / degree, d.inclination / degree);
    fmt::print("throw number         {:.6g}\nmachine number       {:.6g}\n", d.throw_number,
               d.machine_number);
    fmt::print("velocity efficiency  {:.6g}\nmode                 {}\n", d.velocity_efficiency, d.mode);
    fmt::print("held back by         {}\n", fmt::join(d.active_limits, ", "));
    for (auto const& [name, value] : json["sensitivity"].items()) {
        fmt::print("d eta / d {:<22} {:.6g}\n", name, value.get<double>());
    }
}

}  // namespace

void add_theory_design(CLI::App& theory, int& exit_code) {
    CLI::App* const command =
        theory.add_subcommand("design", "Find the machine that conveys fastest within given limits");
    auto const options = std::make_shared<TheoryDesignArguments>();
    auto const add = [&](char const* name, Text& text, char const* help) {
        command->add_option(name, text, help);
    };
    add("--friction", options->friction, "mu, friction coefficient of the material on the trough");
    add("--frequency", options->drive.frequency,
        "Range; default: \"5 Hz to 60 Hz\"; turns of the drive may be written as \"300 rpm to 3600 rpm\"");
    add("--amplitude", options->drive.amplitude, "Range of r, half the stroke; default: \"0.5 mm to 15 mm\"");
    add("--stroke", options->drive.stroke,
        "Range of 2 r, instead of --amplitude, for example \"2 mm to 16 mm\"");
    add("--vibration-angle", options->drive.vibration_angle, "Range of beta; default: \"5 deg to 60 deg\"");
    add("--inclination", options->drive.inclination, "Range of alpha, uphill positive; default: level");
    add("--machine-number", options->drive.machine_number,
        "Largest machine number K that the structure bears; default: 5");
    add("--throw-number", options->drive.throw_number,
        "Largest throw number Gamma; default: 3.29, at which a flight takes one cycle");
    add("--mass-flow", options->mass_flow,
        "Least mass flow, for example \"12 t/h\" or \"2 kg/s\", or by volume \"20 m3/h\"");
    add("--bulk-density", options->bulk_density, "Of the layer, for example \"800 kg/m3\"");
    add("--layer-height", options->layer_height, "For example \"20 mm\"");
    add("--layer-width", options->layer_width, "For example \"200 mm\"");
    add("--gravity", options->gravity, "Default: \"9.81 m/s2\"");
    options->rolling.add_to(*command);
    command->add_flag("--json", options->json, "Print JSON");
    command->footer(
        std::string(
            R"(A range is "LOW to HIGH"; a single value fixes the quantity. Prints the drive of the fastest machine,
its speed and mass flow, the limits that hold it back, and how the velocity efficiency eta changes with each input
there. With --rolling-layer the search stays where that law has been tested.

)") + mode_letters +
        R"(

Example:
  vibrotrough theory design --friction 0.3 --machine-number 4 --frequency "5 Hz to 50 Hz" \
      --amplitude "1 mm to 8 mm" --vibration-angle "10 deg to 45 deg")");
    command->callback([options, &exit_code] {
        run_theory_design(*options);
        exit_code = all_well;
    });
}

}  // namespace vibrotrough::app
