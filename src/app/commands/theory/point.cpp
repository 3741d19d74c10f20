#include "app/commands/command.hpp"
#include "app/commands/theory/options.hpp"
#include "atlas/tables.hpp"
#include "theory/coexisting.hpp"
#include "theory/quantities.hpp"
#include "theory/tested_range.hpp"

#include <numbers>

namespace vibrotrough::app {
namespace {

struct TheoryPointArguments {
    TheoryOptions motion;
    RollingOption rolling;
    QuantityOptions layer;
    bool json = false;
};

/// JSON cannot hold infinity, so an unbounded speed is null.
Json finite_or_null(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json phases_as_json(theory::Motion const& motion) {
    Json phases = Json::array();
    for (theory::Phase const& phase : motion.phases) {
        phases.push_back({{"kind", theory::to_string(phase.kind)},
                          {"start_rad", phase.start},
                          {"end_rad", phase.end},
                          {"relative_displacement", phase.relative_displacement}});
    }
    return phases;
}

Json as_json(theory::Conveyor const& input, theory::ConveyorMotion const& answer) {
    theory::Motion const& motion = answer.motion;
    return {{"velocity_efficiency", finite_or_null(motion.velocity_efficiency)},
            {"half_width", answer.half_width},
            {"mode", motion.mode},
            {"phases", phases_as_json(motion)},
            {"flight_number", motion.flight_number},
            {"period_cycles", motion.period_cycles},
            {"converged", motion.converged},
            {"outcome", theory::to_string(motion.outcome)},
            {"throw_number", input.point.throw_number},
            {"machine_number", theory::machine_number(input.point)},
            {"tan_vibration_angle", input.point.tan_vibration_angle},
            {"tan_inclination", input.point.tan_inclination},
            {"friction", input.point.friction}};
}

using Motions = std::vector<theory::CoexistingMotion>;

Json motions_as_json(Motions const& motions) {
    Json list = Json::array();
    for (auto const& [motion, share] : motions) {
        list.push_back({{"velocity_efficiency", finite_or_null(motion.velocity_efficiency)},
                        {"half_width", motion.half_width},
                        {"mode", theory::to_string(motion.mode)},
                        {"period_cycles", motion.period_cycles},
                        {"fraction", share}});
    }
    return list;
}

/// Says to which motions different starts lead where these are several.
void print_motions(Motions const& motions) {
    if (motions.size() < 2) return;
    fmt::print(
        "several motions      the motion depends on its start; the rest of this answer is that of the "
        "standard "
        "start, at rest at t = 0\n");
    fmt::print("  of {} starts   velocity efficiency   period   mode\n", theory::usual_starts);
    for (auto const& [motion, share] : motions) {
        bool const periodic = motion.outcome == theory::Outcome::periodic;
        std::string const interval =
            motion.half_width > 0 ? fmt::format(" +- {:.6f}", motion.half_width) : "";
        fmt::print("{:>12.0f} %   {:>19}   {:>6}   {}\n", 100 * share,
                   std::isfinite(motion.velocity_efficiency)
                       ? fmt::format("{:.6f}{}", motion.velocity_efficiency, interval)
                       : "runs away",
                   periodic ? std::to_string(motion.period_cycles) : "none", theory::to_string(motion.mode));
    }
}

void print_text(theory::Conveyor const& input, theory::ConveyorMotion const& answer, Motions const& motions,
                std::optional<std::string> const& untested) {
    theory::Motion const& motion = answer.motion;
    fmt::print("throw number         {:.6g}\n", input.point.throw_number);
    fmt::print("machine number       {:.6g}\n", theory::machine_number(input.point));
    if (untested) fmt::print("NOT TESTED           {}\n", *untested);
    std::string const interval =
        answer.half_width > 0 ? fmt::format(" +- {:.6f} (95 %)", answer.half_width) : "";
    std::string const speed = std::isfinite(motion.velocity_efficiency)
                                  ? fmt::format("{:.6f}{}", motion.velocity_efficiency, interval)
                                  : "none";
    fmt::print("velocity efficiency  {}   mean relative velocity / (omega r cos(beta))\n", speed);
    fmt::print("outcome              {}\n", theory::to_string(motion.outcome));
    print_motions(motions);
    if (!motion.converged) return;
    fmt::print("mode                 {}\n", motion.mode);
    fmt::print("period               {} cycle{}\n", motion.period_cycles,
               motion.period_cycles == 1 ? "" : "s");
    fmt::print("flight number        {:.6f}\n\n", motion.flight_number);
    fmt::print("phase   from [deg]     to [deg]   relative displacement [r cos(beta)]\n");
    double const degrees = 180 / std::numbers::pi;
    for (theory::Phase const& phase : motion.phases) {
        fmt::print("{:<5} {:>12.4f} {:>12.4f}   {:>12.6f}\n", theory::to_string(phase.kind),
                   phase.start * degrees, phase.end * degrees, phase.relative_displacement);
    }
}

/// The machine with its layer; none without an amplitude, from which all of these quantities follow.
std::optional<theory::Machine> read_machine(TheoryPointArguments const& o) {
    auto machine = o.motion.machine();
    auto const read = [&](char const* option, double theory::Machine::*value) {
        auto const quantity = o.layer.value(option);
        if (!quantity) return;
        if (!machine) {
            throw core::InputError(fmt::format(
                "{}: needs the amplitude of the machine; write for example --amplitude \"6 mm\"", option));
        }
        (*machine).*value = *quantity;
    };
    read("--bulk-density", &theory::Machine::bulk_density);
    read("--layer-height", &theory::Machine::layer_height);
    read("--layer-width", &theory::Machine::layer_width);
    return machine;
}

/// What a rolling layer has instead of the point mass.
theory::ConveyorMotion solve_rolling(TheoryPointArguments const& options, theory::Conveyor const& input,
                                     theory::RollingLaw const& law) {
    require_plastic(options.motion);
    theory::ConveyorMotion answer;
    answer.motion = theory::solve(theory::RollingLayer{input.point, law}).motion;
    return answer;
}

/// Speed and mass flow of a rolling layer, the quantities that follow from its efficiency alone.
std::vector<theory::NamedQuantity> rolling_quantities(theory::PointMass const& point, double efficiency,
                                                      theory::Machine const& machine) {
    double const omega = theory::angular_frequency(point, machine);
    double const beta = std::atan(point.tan_vibration_angle);
    double const speed = efficiency * omega * machine.amplitude * std::cos(beta);
    double const section = machine.bulk_density * machine.layer_height * machine.layer_width;
    double const frequency = omega / (2 * std::numbers::pi);
    std::vector<theory::NamedQuantity> list{{"frequency", "Hz", frequency},
                                            {"turns_per_minute", "1/min", 60 * frequency},
                                            {"stroke", "mm", 2e3 * machine.amplitude},
                                            {"conveying_speed", "m/s", speed}};
    if (section > 0) {
        list.push_back({"mass_flow", "kg/s", section * speed});
        list.push_back({"mass_flow_per_hour", "t/h", 3.6 * section * speed});
    }
    return list;
}

/// Where the trough is 1e9 times as violent as gravity, friction is lost in the rounding of its motion.
void check_machine_number(theory::Conveyor const& input) {
    double const number = theory::machine_number(input.point);
    if (number <= 1e9) return;
    throw core::InputError(
        fmt::format("the machine number is {:.3g}; no number of such a motion is known, so write inputs for "
                    "which it is at most "
                    "1e9 (real machines are below 100)",
                    number));
}

/// The answer of a law where it has not been tested: none.
void withhold(theory::Conveyor const& input, std::string const& why, bool json) {
    if (json) {
        Json const answer{{"velocity_efficiency", nullptr},
                          {"outside_tested_range", true},
                          {"withheld", why},
                          {"throw_number", input.point.throw_number},
                          {"tan_vibration_angle", input.point.tan_vibration_angle},
                          {"tan_inclination", input.point.tan_inclination},
                          {"friction", input.point.friction}};
        fmt::print("{}\n", answer.dump(2));
        return;
    }
    fmt::print(
        "velocity efficiency  withheld: {} (see validation/rolling_layer); --accept-untested prints it\n",
        why);
}

/// Whether the atlas has layers of this drive, slope and friction.
bool has_layers(theory::PointMass const& point) {
    double const place[] = {point.throw_number, point.tan_vibration_angle, point.tan_inclination,
                            point.friction};  // the first inputs of the atlas
    for (std::size_t i = 0; i < std::size(place); ++i) {
        atlas::SurfaceInput const& range = atlas::inputs()[i];
        if (place[i] < range.low || place[i] > range.high) return false;
    }
    return true;
}

/// Where simulated layers are known to differ from the point mass: the throw numbers of
/// validation/why_theory_fails, whose trough is level.
void print_difference(theory::PointMass const& point) {
    fmt::print("\nThis is a single mass that slides, and not a layer of grains.");
    if (has_layers(point)) {
        bool const is_known =
            point.throw_number > 1.2 && point.throw_number < 2.3 && point.tan_inclination == 0;
        fmt::print(" {}; 'vibrotrough predict' gives the speed of a layer.",
                   is_known
                       ? "Here layers of grains that roll were up to twice as fast"
                       : "Layers of grains that roll differ most from it between throw numbers 1.2 and 2.3");
    }
    fmt::print("\n");
}

/// A motion that runs away has no speed, which a script must notice.
int run_theory_point(TheoryPointArguments const& options) {
    // First: a slip often explains an error, too.
    options.motion.tell_unusual(options.layer.value("--bulk-density"));
    theory::Conveyor const input = options.motion.conveyor();
    auto const law = options.rolling.law();
    check_machine_number(input);
    auto const machine = read_machine(options);
    auto const untested = law ? theory::outside_tested_range(input.point) : std::nullopt;
    if (untested && !options.rolling.accepts_untested()) {
        withhold(input, *untested, options.json);
        return some_cases_failed;
    }
    theory::ConveyorMotion const answer = law ? solve_rolling(options, input, *law) : theory::solve(input);
    Motions const motions = law ? Motions{} : theory::MotionSurvey()(input, theory::efficiency_of(answer));
    Json json = as_json(input, answer);
    if (law) {
        json["outside_tested_range"] = untested.has_value();
    } else {
        json["motions"] = motions_as_json(motions);
    }
    if (!options.json) print_text(input, answer, motions, untested);
    bool const settled = law ? answer.motion.converged : !answer.pieces.empty();
    if (machine && settled) {
        if (!options.json) fmt::print("\n");
        for (auto const& q :
             law ? rolling_quantities(input.point, answer.motion.velocity_efficiency, *machine)
                 : theory::listed(theory::engineer_quantities(answer, *machine))) {
            json["quantities"][q.name] = {{"value", q.value}, {"units", q.unit}};
            if (!options.json) fmt::print("{:<26} {:>12.6g} {}\n", q.name, q.value, q.unit);
        }
    }
    if (!options.json && !law && options.motion.plastic()) print_difference(input.point);
    if (options.json) fmt::print("{}\n", json.dump(2));
    return std::isfinite(answer.motion.velocity_efficiency) ? all_well : some_cases_failed;
}

}  // namespace

void add_theory_point(CLI::App& theory, int& exit_code) {
    CLI::App* const command = theory.add_subcommand(
        "point", "Solve one motion of a point mass: phases, mode and velocity efficiency");
    auto const options = std::make_shared<TheoryPointArguments>();
    options->motion.add_to(*command);
    options->rolling.add_to(*command);
    options->layer.add_to(*command, {{"--bulk-density"}, {"--layer-height"}, {"--layer-width"}},
                          "The layer, for the mass flow");
    command->add_flag("--json", options->json,
                      "Print JSON, with phases as angles omega t in rad and displacements in r cos(beta)");
    command->footer(
        std::string(
            R"(The theory is that of Sloot & Kruyt (1996) with extensions. Prints the velocity efficiency (the mean
velocity of the mass relative to the trough over omega r cos(beta)), the mode, and a table of its phases. When the
machine's frequency and stroke are known (both, or one of them and --throw-number), it also prints speed, impacts,
energies and forces, with the size and bulk density of the layer the mass flow in kg/s and t/h, and the power per area.

With rebounds the long-term motion can depend on the start. 64 starts are followed: at rest at t = 0 (the standard
start), and with rebounds and slip velocities within what the trough can give. Where they lead to several motions, each
is listed with its velocity efficiency and the fraction of the starts that lead to it.

)") + mode_letters +
        R"(

Example:
  vibrotrough theory point --throw-number 2 --vibration-angle "30 deg" --friction 0.23

Example with a machine:
  vibrotrough theory point --frequency "800 rpm" --stroke "12 mm" --vibration-angle "30 deg" \
      --friction 0.23 --layer-height "12 mm" --layer-width "0.2 m" --bulk-density "800 kg/m3"

Example of a layer of grains that roll (validation/rolling_layer says what this law predicts and what it does not):
  vibrotrough theory point --throw-number 1.7 --tan-vibration-angle 0.5 --friction 0.23 \
      --rolling-layer)");
    command->callback([options, &exit_code] { exit_code = run_theory_point(*options); });
}

}  // namespace vibrotrough::app
