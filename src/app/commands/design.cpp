#include "app/commands.hpp"
#include "app/commands/theory/options.hpp"
#include "app/exit_code.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "learn/risk_design.hpp"

#include <map>
#include <memory>
#include <numbers>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr double degree = std::numbers::pi / 180;
constexpr double tonnes_per_hour = 3.6;  // in kg/s

struct Options {
    Text mass_flow, bulk_density, width, length, friction, friction_uncertainty, calibration, discrepancy;
    Text rpm, stroke, vibration_angle, inclination, depth, machine_number, throw_number, landing_speed,
        confidence;
    std::string objective = "fastest", campaign;
    bool json = false;
};

std::map<std::string, learn::Objective> const objectives{
    {"fastest", learn::Objective::fastest},
    {"gentlest-landing", learn::Objective::gentlest_landing},
    {"least-machine-number", learn::Objective::least_machine_number},
    {"least-power", learn::Objective::least_power}};

/// "LOW to HIGH", or one value for both.
theory::Range read_range(char const* option, std::string const& text, std::string const& example,
                         auto const& read_one) {
    auto const middle = text.find(" to ");
    theory::Range const range =
        middle == std::string::npos
            ? theory::Range{read_one(text), read_one(text)}
            : theory::Range{read_one(text.substr(0, middle)), read_one(text.substr(middle + 4))};
    if (range.low <= range.high) return range;
    throw core::InputError(
        fmt::format("{} {}: the first value is above the second; write for example {} \"{}\"", option, text,
                    option, example));
}

/// Median and standard uncertainty of the friction that `vibrotrough theory calibrate --json` printed.
void read_calibration(std::string const& file, learn::DesignTask& task) {
    try {
        for (auto const& parameter : Json::parse(core::read_file(file)).at("parameters")) {
            std::string const name = parameter.at("name");
            if (name != "friction" && name != "trough.friction") continue;
            task.friction = parameter.at("median");
            task.friction_sd =
                (parameter.at("high").get<double>() - parameter.at("low").get<double>()) / 3.92;
            return;
        }
    } catch (nlohmann::json::exception const&) {
        // Falls through to the same message.
    }
    throw core::InputError(
        fmt::format("--calibration {}: holds no calibrated friction; give what 'vibrotrough theory calibrate "
                    "speeds.csv --free friction --json' prints",
                    file));
}

void read_drive(Options const& o, theory::DesignLimits& l) {
    auto const quantity = [](char const* option, char const* unit, char const* example) {
        return [=](std::string const& text) { return read_positive_quantity(option, text, unit, example); };
    };
    auto const angle = [](char const* option, char const* example, double low) {
        return [=](std::string const& text) { return read_angle(option, text, example, low, 90); };
    };
    if (o.rpm) {
        auto const number = [](std::string const& text) {
            return read_number_within("--rpm", text, "300 to 1500", 1, 1e5) / 60;
        };
        l.frequency = read_range("--rpm", *o.rpm, "300 to 1500", number);
    }
    if (o.stroke) {
        l.amplitude =
            read_range("--stroke", *o.stroke, "2 mm to 16 mm", quantity("--stroke", "m", "2 mm to 16 mm"));
        l.amplitude = {l.amplitude.low / 2, l.amplitude.high / 2};
    }
    if (o.vibration_angle)
        l.vibration_angle = read_range("--vibration-angle", *o.vibration_angle, "20 deg to 40 deg",
                                       angle("--vibration-angle", "30 deg", 0));
    if (o.inclination)
        l.inclination = read_range("--inclination", *o.inclination, "-5 deg to 0 deg",
                                   angle("--inclination", "-5 deg", -90));
    if (o.machine_number)
        l.max_machine_number = read_number_within("--machine-number", *o.machine_number, "4", 1e-3, 1e4);
    if (o.throw_number)
        l.max_throw_number = read_number_within("--throw-number", *o.throw_number, "3", 1e-3, 1e4);
}

learn::DesignTask read(Options const& o) {
    learn::DesignTask task{};
    if (o.calibration) {
        if (o.friction || o.friction_uncertainty)
            throw core::InputError(
                "--calibration gives the friction; leave --friction and --friction-uncertainty out");
        read_calibration(*o.calibration, task);
    } else {
        task.friction =
            read_number_within("--friction", required("--friction", o.friction, "0.3"), "0.3", 1e-3, 10);
        task.friction_sd = o.friction_uncertainty ? read_number_within("--friction-uncertainty",
                                                                       *o.friction_uncertainty, "0.03", 0, 1)
                                                  : 0;
    }
    if (o.discrepancy)
        task.discrepancy = read_number_within("--model-discrepancy", *o.discrepancy, "0.05", 0, 1);
    auto const quantity = [](char const* option, Text const& text, char const* unit, char const* example) {
        return read_positive_quantity(option, required(option, text, fmt::format("\"{}\"", example)), unit,
                                      example);
    };
    task.mass_flow = quantity("--mass-flow", o.mass_flow, "kg/s", "12 t/h");
    task.bulk_density = quantity("--bulk-density", o.bulk_density, "kg/m3", "800 kg/m3");
    task.width = quantity("--width", o.width, "m", "300 mm");
    if (o.length) task.length = quantity("--length", o.length, "m", "3 m");
    if (o.landing_speed) task.landing_speed = quantity("--landing-speed", o.landing_speed, "m/s", "0.3 m/s");
    if (o.confidence) task.confidence = read_number_within("--confidence", *o.confidence, "0.95", 0.5, 0.999);
    if (o.depth) {
        auto const depth = [](std::string const& text) {
            return read_positive_quantity("--layer-depth", text, "m", "5 mm to 60 mm");
        };
        task.depth = read_range("--layer-depth", *o.depth, "5 mm to 60 mm", depth);
    }
    read_drive(o, task.limits);
    task.objective = objectives.at(o.objective);
    return task;
}

/// A campaign that checks the design with grains of 3 mm; its grains are assumptions, which the file says.
std::string campaign_text(learn::DesignTask const& task, learn::RiskDesign const& d) {
    theory::Design const& m = d.machine;
    return fmt::format(
        R"(# Checks a design of 'vibrotrough design' with grains. The grains are assumed: 3 mm spheres. Put in yours.
[campaign]
name = "design"

[trough]
inclination = "{:.6g} deg"
vibration_angle = "{:.6g} deg"
amplitude = "{:.6g} mm"      # half the stroke
frequency = "{:.6g} Hz"
friction = {:.4g}
restitution = 0.5

[grains]
diameter = "3 mm"
diameter_spread = 0.1
density = "{:.4g} kg/m3"     # bulk density over 0.58
youngs_modulus = "5 MPa"
poisson_ratio = 0.35
friction = 0.5
restitution = 0.5

[layer]
length = "36 mm"
width = "18 mm"
height = "{:.4g} mm"

[measure]
packings = 4
half_width = 0.03

[sweep]
"trough.friction" = [{:.4g}, {:.4g}, {:.4g}]
)",
        m.inclination / degree, m.vibration_angle / degree, 1e3 * m.amplitude, m.frequency, task.friction,
        task.bulk_density / 0.58, 1e3 * std::max(d.depth, 0.009),
        std::max(0.01, task.friction - std::max(0.05, 2 * task.friction_sd)), task.friction,
        task.friction + std::max(0.05, 2 * task.friction_sd));
}

Json as_json(learn::DesignTask const& task, learn::RiskDesign const& d) {
    theory::Design const& m = d.machine;
    Json json{{"feasible", d.feasible},
              {"stroke_mm", 2e3 * m.amplitude},
              {"amplitude_m", m.amplitude},
              {"rpm", 60 * m.frequency},
              {"frequency_hz", m.frequency},
              {"vibration_angle_deg", m.vibration_angle / degree},
              {"inclination_deg", m.inclination / degree},
              {"throw_number", m.throw_number},
              {"machine_number", m.machine_number},
              {"velocity_efficiency", m.velocity_efficiency},
              {"conveying_speed_m_per_s", m.conveying_speed},
              {"sure_speed_m_per_s", d.sure_speed},
              {"layer_depth_m", d.depth},
              {"mass_flow_t_per_h", tonnes_per_hour * d.median_flow},
              {"mass_flow_low_t_per_h", tonnes_per_hour * d.low_flow},
              {"mass_flow_high_t_per_h", tonnes_per_hour * d.high_flow},
              {"mass_flow_wanted_t_per_h", tonnes_per_hour * task.mass_flow},
              {"probability", d.probability},
              {"confidence", task.confidence},
              {"landing_speed_m_per_s", d.landing_speed},
              {"power_w", d.power ? Json(*d.power) : Json()},
              {"active_limits", d.active_limits},
              {"warnings", d.warnings},
              {"rule_of_thumb_m_per_s", learn::rule_of_thumb(m.frequency, m.amplitude)}};
    return json;
}

void print_text(learn::DesignTask const& task, learn::RiskDesign const& d) {
    theory::Design const& m = d.machine;
    double const wanted = tonnes_per_hour * task.mass_flow;
    if (d.feasible) {
        fmt::print("This trough carries {:.4g} t/h with a probability of {:.1f} %.\n\n", wanted,
                   100 * d.probability);
    } else {
        fmt::print(
            "No machine within the limits carries {:.4g} t/h with a probability of {:.4g} %; the fastest one "
            "does with {:.1f} %.\n\n",
            wanted, 100 * task.confidence, 100 * d.probability);
    }
    fmt::print("stroke            {:.4g} mm (amplitude {:.4g} mm)\n", 2e3 * m.amplitude, 1e3 * m.amplitude);
    fmt::print("revolutions       {:.4g} 1/min ({:.4g} Hz)\n", 60 * m.frequency, m.frequency);
    fmt::print("vibration angle   {:.3g} degrees\ninclination       {:.3g} degrees\n",
               m.vibration_angle / degree, m.inclination / degree);
    fmt::print("layer depth       {:.3g} mm\n", 1e3 * d.depth);
    fmt::print("mass flow         {:.3g} t/h ({:.3g} to {:.3g} in 95 % of cases)\n",
               tonnes_per_hour * d.median_flow, tonnes_per_hour * d.low_flow, tonnes_per_hour * d.high_flow);
    fmt::print(
        "conveying speed   {:.3g} m/s at the median of the friction, {:.3g} m/s or more with {:.4g} %\n",
        m.conveying_speed, d.sure_speed, 100 * task.confidence);
    fmt::print("throw number      {:.3g}\nmachine number    {:.3g}\nmode              {}\n", m.throw_number,
               m.machine_number, m.mode);
    fmt::print("landing speed     {:.3g} m/s\n", d.landing_speed);
    if (d.power) fmt::print("power             {:.3g} W given to the material\n", *d.power);
    fmt::print("held back by      {}\n",
               d.active_limits.empty() ? "nothing" : fmt::format("{}", fmt::join(d.active_limits, ", ")));
    double const rule = learn::rule_of_thumb(m.frequency, m.amplitude);
    fmt::print(
        "rule of thumb     {:.3g} m/s, of which 70 to 80 % ({:.3g} to {:.3g} m/s) are used in practice "
        "(Daesung Machinery: v = 3.81 N S)\n",
        rule, 0.7 * rule, 0.8 * rule);
    for (std::string const& warning : d.warnings) fmt::print("\n{}\n", warning);
}

int run(Options const& options) {
    learn::DesignTask const task = read(options);
    learn::RiskDesign design;
    try {
        design = learn::design_with_risk(task);
    } catch (std::invalid_argument const& error) {
        throw core::InputError(fmt::format("no machine fits: {}; widen the limits", error.what()));
    }
    if (!options.campaign.empty()) core::write_file_atomically(options.campaign, campaign_text(task, design));
    if (options.json) {
        fmt::print("{}\n", as_json(task, design).dump(2));
    } else {
        print_text(task, design);
    }
    return design.feasible ? all_well : some_cases_failed;
}

}  // namespace

void add_design(CLI::App& program, int& exit_code) {
    CLI::App* const command =
        program.add_subcommand("design", "Find stroke, speed and layer depth for a mass flow, with the risk");
    auto const options = std::make_shared<Options>();
    auto const add = [&](char const* name, Text& text, char const* help) {
        command->add_option(name, text, help);
    };
    add("--mass-flow", options->mass_flow, "To be reached, for example \"12 t/h\"");
    add("--bulk-density", options->bulk_density, "Of the material, for example \"800 kg/m3\"");
    add("--width", options->width, "Of the trough, for example \"300 mm\"");
    add("--length", options->length, "Of the trough, for the power, for example \"3 m\"");
    add("--friction", options->friction, "mu, friction coefficient of the material on the trough");
    add("--friction-uncertainty", options->friction_uncertainty,
        "Its standard uncertainty (one standard deviation); default: 0");
    add("--calibration", options->calibration,
        "In place of both: a file with the output of 'vibrotrough theory calibrate --json'");
    add("--model-discrepancy", options->discrepancy,
        "Standard deviation of the theory's error, in velocity efficiency; default: 0.05");
    add("--rpm", options->rpm, "Range of revolutions per minute; default: \"300 to 3600\"");
    add("--stroke", options->stroke, "Range, twice the amplitude; default: \"1 mm to 30 mm\"");
    add("--vibration-angle", options->vibration_angle, "Range of beta; default: \"5 deg to 60 deg\"");
    add("--inclination", options->inclination, "Range of alpha, uphill positive; default: level");
    add("--layer-depth", options->depth, "Range; default: \"2 mm to 100 mm\"");
    add("--machine-number", options->machine_number,
        "Largest machine number K that the structure bears; default: 5");
    add("--throw-number", options->throw_number, "Largest throw number Gamma; default: 3.29");
    add("--landing-speed", options->landing_speed,
        "Largest speed of an impact on the trough, for example \"0.3 m/s\"");
    add("--confidence", options->confidence,
        "Probability with which the mass flow is to be reached; default: 0.95");
    command->add_option("--objective", options->objective, "What the machine is to be best at")
        ->check(CLI::IsMember({"fastest", "gentlest-landing", "least-machine-number", "least-power"}))
        ->capture_default_str();
    command
        ->add_option("--campaign", options->campaign,
                     "Write a campaign file that checks the design with grains")
        ->type_name("FILE");
    command->add_flag("--json", options->json, "Print JSON");
    command->footer(
        R"(A range is "LOW to HIGH"; a single value fixes the quantity. The design rests on the point-mass theory. Its speed is
uncertain because the friction is, and because the theory is not exact; the layer is made so deep that the mass flow is
reached with the stated probability. The answer names what holds the machine back, and warns where layers of grains that
roll are known to differ from the theory.

Exit codes:
    0  the mass flow can be reached
    1  it cannot; the fastest machine within the limits is printed
    2  the input is wrong

Example:
  vibrotrough design --mass-flow "12 t/h" --bulk-density "800 kg/m3" --width "300 mm" --friction 0.3 \
      --friction-uncertainty 0.03 --machine-number 4 --layer-depth "5 mm to 40 mm")");
    command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vibrotrough::app
