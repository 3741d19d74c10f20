#include "app/commands/theory/options.hpp"

#include "app/commands/command.hpp"
#include "core/quantity.hpp"

namespace vibrotrough::app {
namespace {

using theory::Input;

/// Reads "3,0.1,30 deg": order, amplitude of acceleration, phase.
theory::Harmonic read_harmonic(std::string const& option, std::string const& text) {
    constexpr char const* example = "\"3,0.1,30 deg\"";
    auto const first = text.find(','),
               second = first == std::string::npos ? first : text.find(',', first + 1);
    if (second == std::string::npos) {
        throw core::InputError(fmt::format("{} {}: needs order, amplitude and phase; write for example {} {}",
                                           option, text, option, example));
    }
    theory::Harmonic harmonic{};
    harmonic.order = read_count(option, text.substr(0, first), example, 1, 100);
    harmonic.amplitude =
        read_number_within(option, text.substr(first + 1, second - first - 1), example, -100, 100);
    try {
        harmonic.phase = core::parse_quantity(text.substr(second + 1), "radian");
    } catch (core::QuantityError const& error) {
        throw core::InputError(fmt::format("{} {}: {}; write for example {} {}", option, text,
                                           error.problem(), option, example));
    }
    return harmonic;
}

}  // namespace

void TheoryOptions::add_to(CLI::App& command) {
    quantities_.add_to(command, {{"--throw-number", "; above 1 the mass flies"},
                                 {"--machine-number", ", instead of --throw-number"},
                                 {"--vibration-angle", ", for example \"30 deg\""},
                                 {"--tan-vibration-angle", ", instead of --vibration-angle"},
                                 {"--inclination", ", for example \"-3 deg\"; default: level"},
                                 {"--tan-inclination", ", instead of --inclination"},
                                 {"--friction"}});
    std::string const machine = "The machine";
    quantities_.add_to(command,
                       {{"--frequency",
                         "; with the amplitude it replaces --throw-number, and beside --throw-number it "
                         "replaces the amplitude"},
                        {"--amplitude", ", for example \"6 mm\""},
                        {"--stroke", ", instead of --amplitude"},
                        {"--gravity"}},
                       machine);
    command
        .add_option("--rpm", rpm_, "Turns of the drive per minute, instead of --frequency, for example 960")
        ->group(machine);
    char const* const group = "Beyond the plastic point mass of Sloot & Kruyt (1996)";
    quantities_.add_beyond_plastic(command, group);
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
    quantities_.refuse_both("--amplitude", "--stroke");
    if (auto const stroke = quantities_.value("--stroke")) return *stroke / 2;
    return quantities_.value("--amplitude");
}

std::optional<double> TheoryOptions::frequency() const {
    refuse_both("--frequency", quantities_.text("--frequency"), "--rpm", rpm_);
    return rpm_ ? read_turns("--rpm", *rpm_) : quantities_.value("--frequency");
}

double TheoryOptions::gravity() const {
    return quantities_.value("--gravity").value_or(theory::Machine{}.gravity);
}

/// Throw number, machine number, frequency and amplitude: two of them are a drive.
void TheoryOptions::set_frequency(theory::Inputs& inputs) const {
    auto const r = amplitude();
    if (r) inputs.set(Input::amplitude_m, *r);
    auto const f = frequency();
    if (!f) return;
    bool const has_throw = quantities_.has("--throw-number");
    bool const has_number = has_throw || quantities_.has("--machine-number");
    if (has_number && r) {
        throw core::InputError(
            fmt::format("{}: follows from {} and the amplitude, which are also given; leave one of the three "
                        "out",
                        rpm_ ? "--rpm" : "--frequency", has_throw ? "--throw-number" : "--machine-number"));
    }
    if (has_number) return;
    if (r && quantities_.has("--gravity")) {
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
    numbers.is_stroke = quantities_.has("--stroke");
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
    quantities_.refuse_both("--throw-number", "--machine-number");
    quantities_.refuse_both("--vibration-angle", "--tan-vibration-angle");
    quantities_.refuse_both("--inclination", "--tan-inclination");
    theory::Inputs inputs;
    quantities_.set_inputs(inputs);
    set_frequency(inputs);
    if (auto const beta = quantities_.value("--vibration-angle"))
        inputs.set(Input::tan_vibration_angle, std::tan(*beta));
    if (auto const alpha = quantities_.value("--inclination"))
        inputs.set(Input::tan_inclination, std::tan(*alpha));
    if (inputs.get(Input::throw_number) && inputs.get(Input::tan_vibration_angle) == 0)
        throw core::InputError(
            "--vibration-angle: a trough that vibrates along its own surface has throw number 0; write "
            "--machine-number instead of --throw-number");
    auto const standing = inputs.get(Input::static_friction), kinetic = inputs.get(Input::friction);
    if (standing && kinetic && *standing < *kinetic)
        throw core::InputError(fmt::format(
            "--static-friction {}: is below --friction {}; write a larger value", *standing, *kinetic));
    return inputs;
}

int count_starts(QuantityOptions const& options, bool rolling_layer) {
    auto const starts = options.value("--starts");
    if (starts && rolling_layer)
        throw core::InputError("--starts: a rolling layer has one start; leave the option out");
    return static_cast<int>(starts.value_or(0));
}

void require_complete(theory::Inputs const& inputs) {
    auto const missing = [](char const* option) {
        throw core::InputError(
            fmt::format("{} is missing; write for example {}", option, option_row(option).written_example()));
    };
    bool const has_frequency = inputs.get(Input::frequency_hz).has_value();
    if (!inputs.get(Input::throw_number) && !inputs.get(Input::machine_number) && !has_frequency)
        missing("--throw-number");
    if (has_frequency && !inputs.amplitude()) missing("--amplitude");
    if (!inputs.get(Input::tan_vibration_angle) && !inputs.get(Input::vibration_angle_deg))
        missing("--vibration-angle");
    if (!inputs.get(Input::friction)) missing("--friction");
    if (auto const problem = inputs.incomplete()) throw core::InputError(*problem);
}

bool TheoryOptions::plastic() const {
    return given().plastic() && along_.empty() && normal_.empty() && !table_1_rule_;
}

void require_plastic(TheoryOptions const& motion) {
    if (motion.plastic()) return;
    throw core::InputError(
        "--rolling-layer: the law has only a sinusoidal drive, inclination and friction; leave the other "
        "options out");
}

theory::Conveyor TheoryOptions::conveyor() const {
    theory::Inputs const inputs = given();
    require_complete(inputs);
    theory::Conveyor conveyor = inputs.conveyor();
    for (auto const& text : along_) conveyor.along.push_back(read_harmonic("--harmonic-along", text));
    for (auto const& text : normal_) conveyor.normal.push_back(read_harmonic("--harmonic-normal", text));
    if (table_1_rule_) conveyor.flight_start = theory::FlightStart::trough_velocity_rule;
    return conveyor;
}

}  // namespace vibrotrough::app
