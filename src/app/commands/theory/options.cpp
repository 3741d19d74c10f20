#include "app/commands/theory/options.hpp"

#include "app/standard_streams.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

using theory::Input;

constexpr double least_throw = 1e-300;  // the theory divides by it

double read_throw(std::string const& option, std::string const& text) {
    double const value = read_number(option, text, "2");
    if (value > 0 && value <= theory::largest_throw_number) return std::max(value, least_throw);
    throw core::InputError(
        fmt::format("{} {}: must be above 0 and at most 100; write for example {} 2", option, text, option));
}

/// Reads "3,0.1,30 deg": order, amplitude of acceleration, phase.
theory::Harmonic read_harmonic(std::string const& option, std::string const& text) {
    auto const first = text.find(','),
               second = first == std::string::npos ? first : text.find(',', first + 1);
    if (second == std::string::npos) {
        throw core::InputError(
            fmt::format("{} {}: needs order, amplitude and phase; write for example {} \"3,0.1,30 deg\"",
                        option, text, option));
    }
    theory::Harmonic harmonic{};
    harmonic.order = read_count(option, text.substr(0, first), "\"3,0.1,30 deg\"", 1, 100);
    harmonic.amplitude =
        read_number_within(option, text.substr(first + 1, second - first - 1), "\"3,0.1,30 deg\"", -100, 100);
    harmonic.phase = read_angle(option, text.substr(second + 1), "3,0.1,30 deg", -720, 720);
    return harmonic;
}

}  // namespace

void TheoryOptions::add_to(CLI::App& command) {
    command.add_option("--throw-number", throw_number_,
                       "Gamma = omega^2 r sin(beta) / (g cos(alpha)); above 1 the mass flies");
    command.add_option("--machine-number", machine_number_, "K = omega^2 r / g, instead of --throw-number");
    command.add_option(
        "--vibration-angle", vibration_angle_,
        "beta, the angle between the direction of vibration and the trough, for example \"30 deg\"");
    command.add_option("--tan-vibration-angle", tan_vibration_angle_,
                       "tan(beta), instead of --vibration-angle");
    command.add_option("--inclination", inclination_,
                       "alpha, uphill positive, for example \"-3 deg\"; default: level");
    command.add_option("--tan-inclination", tan_inclination_, "tan(alpha), instead of --inclination");
    command.add_option("--friction", friction_, "mu, friction coefficient of the mass on the trough");
    add_machine(command);
    add_extensions(command);
}

void TheoryOptions::add_machine(CLI::App& command) {
    auto const add = [&](char const* name, Text& text, char const* help) {
        command.add_option(name, text, help)->group("The machine");
    };
    add("--frequency", frequency_,
        "Cycles per time, for example \"25 Hz\" or \"1500 rpm\"; with the amplitude it replaces "
        "--throw-number, and beside --throw-number it replaces the amplitude");
    add("--rpm", rpm_, "Turns of the drive per minute, instead of --frequency, for example 960");
    add("--amplitude", amplitude_, "r in the direction of vibration, half the stroke, for example \"6 mm\"");
    add("--stroke", stroke_, "2 r, instead of --amplitude, for example \"12 mm\"");
    add("--gravity", gravity_, "Default: \"9.81 m/s2\"");
}

void TheoryOptions::add_extensions(CLI::App& command) {
    char const* const group = "Beyond the plastic point mass of Sloot & Kruyt (1996)";
    auto const add = [&](char const* name, Text& text, char const* help) {
        command.add_option(name, text, help)->group(group);
    };
    add("--restitution", restitution_,
        "e, normal restitution coefficient, from 0 (plastic, default) to 0.95 (Eq. 23)");
    add("--slowest-rebound", slowest_rebound_,
        "Rebounds slower than this count as contact, in omega r sin(beta); default: 1e-6");
    add("--static-friction", static_friction_,
        "Static friction coefficient, at least --friction, which is then the kinetic one");
    add("--landing-friction", landing_friction_,
        "Friction coefficient during a landing: the ratio of tangential to normal impulse that it can reach; "
        "default: mu");
    add("--air-drag", air_drag_, "kappa: the drag force is m omega kappa times the velocity");
    add("--along-ratio", along_ratio_, "Elliptical drive: amplitude along the trough over r cos(beta)");
    add("--along-phase", along_phase_,
        "Elliptical drive: phase lead of the motion along the trough, for example \"20 deg\"");
    add("--wall-friction", wall_friction_, "Friction coefficient of the layer on the side walls");
    add("--wall-pressure-ratio", wall_pressure_ratio_,
        "Janssen's k, horizontal over vertical stress; default: 0.5");
    add("--height-over-width", height_over_width_,
        "Height of the layer over its width, for side-wall friction");
    command
        .add_option("--harmonic-along", along_,
                    "Further acceleration along the trough: \"ORDER,AMPLITUDE,PHASE\", for example "
                    "\"3,0.1,30 deg\"; repeat the option for several")
        ->group(group);
    command
        .add_option("--harmonic-normal", normal_,
                    "Further acceleration normal to the trough, written in the same way")
        ->group(group);
    command
        .add_flag("--table-1-rule", table_1_rule_,
                  "Start a flight that interrupts an N' slide with the velocity of the trough. This is not "
                  "physical; it only reproduces Table 1 of the paper at e > 0")
        ->group(group);
}

std::optional<double> TheoryOptions::amplitude() const {
    refuse_both("--amplitude", amplitude_, "--stroke", stroke_);
    if (stroke_) return read_positive_quantity("--stroke", *stroke_, "m", "12 mm") / 2;
    if (amplitude_) return read_positive_quantity("--amplitude", *amplitude_, "m", "6 mm");
    return {};
}

std::optional<double> TheoryOptions::frequency() const {
    refuse_both("--frequency", frequency_, "--rpm", rpm_);
    if (rpm_) return read_turns("--rpm", *rpm_);
    if (frequency_) return read_positive_quantity("--frequency", *frequency_, "Hz", "25 Hz");
    return {};
}

double TheoryOptions::gravity() const {
    return gravity_ ? read_positive_quantity("--gravity", *gravity_, "m/s2", "9.81 m/s2")
                    : theory::Machine{}.gravity;
}

/// Throw number, machine number, frequency and amplitude: two of them are a drive.
void TheoryOptions::set_drive(theory::Inputs& inputs) const {
    auto const r = amplitude();
    if (throw_number_) inputs.set(Input::throw_number, read_throw("--throw-number", *throw_number_));
    if (machine_number_) inputs.set(Input::machine_number, read_throw("--machine-number", *machine_number_));
    bool const has_number = throw_number_ || machine_number_;
    if (r) inputs.set(Input::amplitude_m, *r);
    auto const f = frequency();
    if (!f) return;
    if (has_number && r) {
        throw core::InputError(
            fmt::format("{} {}: follows from {} and the amplitude, which are also given; leave one "
                        "of the three out",
                        rpm_ ? "--rpm" : "--frequency", rpm_ ? *rpm_ : *frequency_,
                        throw_number_ ? "--throw-number" : "--machine-number"));
    }
    if (has_number) return;
    if (r && gravity_) {
        double const omega = 2 * std::numbers::pi * *f;
        inputs.set(Input::machine_number, omega * omega * *r / gravity());
    } else {
        inputs.set(Input::frequency_hz, *f);
    }
}

std::optional<theory::Machine> TheoryOptions::machine() const {
    theory::Machine machine{};
    machine.gravity = gravity();
    if (auto const r = amplitude()) {
        machine.amplitude = *r;
        return machine;
    }
    auto const f = frequency();
    if (!f) return {};
    double const omega = 2 * std::numbers::pi * *f;
    machine.amplitude = theory::machine_number(conveyor().point) * machine.gravity / (omega * omega);
    return machine;
}

void tell_unusual(theory::MachineNumbers const& numbers) {
    for (std::string const& sentence : theory::unusual_numbers(numbers))
        tell("vibrotrough: warning: {}\n", sentence);
}

void TheoryOptions::tell_unusual(std::optional<double> bulk_density) const {
    theory::Inputs const inputs = given();
    theory::MachineNumbers numbers{frequency(), amplitude(), {}, inputs.get(Input::friction)};
    numbers.is_stroke = stroke_.has_value();
    numbers.is_turns = rpm_.has_value();
    if (auto const tangent = inputs.get(Input::tan_vibration_angle))
        numbers.vibration_angle = std::atan(*tangent);
    if (numbers.frequency && numbers.amplitude) {
        double const omega = 2 * std::numbers::pi * *numbers.frequency;
        numbers.machine_number = omega * omega * *numbers.amplitude / gravity();
    }
    numbers.bulk_density = bulk_density;
    app::tell_unusual(numbers);
}

theory::Inputs TheoryOptions::given() const {
    refuse_both("--throw-number", throw_number_, "--machine-number", machine_number_);
    refuse_both("--vibration-angle", vibration_angle_, "--tan-vibration-angle", tan_vibration_angle_);
    refuse_both("--inclination", inclination_, "--tan-inclination", tan_inclination_);
    theory::Inputs inputs;
    set_drive(inputs);
    bool const may_be_level = machine_number_ || ((frequency_ || rpm_) && !throw_number_);
    if (vibration_angle_) {
        double const beta =
            read_angle("--vibration-angle", *vibration_angle_, "30 deg", may_be_level ? -1e-12 : 0, 90);
        inputs.set(Input::tan_vibration_angle, std::tan(beta));
    }
    if (inclination_) {
        inputs.set(Input::tan_inclination,
                   std::tan(read_angle("--inclination", *inclination_, "-3 deg", -90, 90)));
    }
    if (along_phase_) {
        inputs.set(Input::along_phase_deg,
                   read_angle("--along-phase", *along_phase_, "20 deg", -720, 720) / degree);
    }
    auto const set = [&](Input input, char const* option, Text const& text, char const* example, double low,
                         double high) {
        if (text) inputs.set(input, read_number_within(option, *text, example, low, high));
    };
    set(Input::tan_vibration_angle, "--tan-vibration-angle", tan_vibration_angle_, "0.5",
        may_be_level ? 0 : 1e-300, 1e6);
    set(Input::tan_inclination, "--tan-inclination", tan_inclination_, "-0.05", -1e6, 1e6);
    set(Input::friction, "--friction", friction_, "0.3", 0, 1e6);
    set(Input::static_friction, "--static-friction", static_friction_, "0.4", 0, 1e6);
    set(Input::landing_friction, "--landing-friction", landing_friction_, "0.1", 0, 1e6);
    set(Input::restitution, "--restitution", restitution_, "0.2", 0, 0.95);
    set(Input::air_drag, "--air-drag", air_drag_, "0.01", 0, 1000);
    set(Input::along_ratio, "--along-ratio", along_ratio_, "0.8", -1000, 1000);
    set(Input::wall_friction, "--wall-friction", wall_friction_, "0.3", 0, 1000);
    set(Input::wall_pressure_ratio, "--wall-pressure-ratio", wall_pressure_ratio_, "0.5", 0, 1);
    set(Input::height_over_width, "--height-over-width", height_over_width_, "0.2", 0, 1000);
    auto const standing = inputs.get(Input::static_friction), kinetic = inputs.get(Input::friction);
    if (standing && kinetic && *standing < *kinetic) {
        throw core::InputError(
            fmt::format("--static-friction {}: is below --friction {}; write a larger value",
                        *static_friction_, *friction_));
    }
    return inputs;
}

void StartsOption::add_to(CLI::App& command) {
    command.add_option(
        "--starts", text_,
        "Follow so many starts of each motion, for example 64, and write to which motions they lead: with "
        "rebounds there can be several. Default: the standard start alone, at rest at t = 0");
}

int StartsOption::count(bool rolling_layer) const {
    if (!text_) return 0;
    if (rolling_layer) {
        throw core::InputError(
            fmt::format("--starts {}: a rolling layer has one start; leave the option out", *text_));
    }
    return read_count("--starts", *text_, "64", 2, 1000000);
}

void require_complete(theory::Inputs const& inputs) {
    auto const missing = [](char const* option, char const* example) {
        throw core::InputError(
            fmt::format("{} is missing; write for example {} {}", option, option, example));
    };
    bool const has_frequency = inputs.get(Input::frequency_hz).has_value();
    if (!inputs.get(Input::throw_number) && !inputs.get(Input::machine_number) && !has_frequency)
        missing("--throw-number", "2");
    if (has_frequency && !inputs.amplitude()) missing("--amplitude", "\"6 mm\"");
    if (!inputs.get(Input::tan_vibration_angle) && !inputs.get(Input::vibration_angle_deg)) {
        missing("--vibration-angle", "\"30 deg\"");
    }
    if (!inputs.get(Input::friction)) missing("--friction", "0.3");
    if (auto const problem = inputs.incomplete()) throw core::InputError(*problem);
}

bool TheoryOptions::plastic() const {
    return given().plastic() && along_.empty() && normal_.empty() && !table_1_rule_;
}

theory::Conveyor TheoryOptions::conveyor() const {
    theory::Inputs const inputs = given();
    require_complete(inputs);
    theory::Conveyor conveyor = inputs.conveyor();
    if (slowest_rebound_) {
        conveyor.slowest_rebound =
            read_number_within("--slowest-rebound", *slowest_rebound_, "1e-6", 1e-9, 1);
    }
    for (auto const& text : along_) conveyor.along.push_back(read_harmonic("--harmonic-along", text));
    for (auto const& text : normal_) conveyor.normal.push_back(read_harmonic("--harmonic-normal", text));
    if (table_1_rule_) conveyor.flight_start = theory::FlightStart::trough_velocity_rule;
    return conveyor;
}

}  // namespace vibrotrough::app
