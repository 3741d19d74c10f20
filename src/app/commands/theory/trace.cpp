#include "app/commands/command.hpp"
#include "app/commands/theory/options.hpp"
#include "app/outputs.hpp"
#include "theory/quantities.hpp"
#include "theory/tested_range.hpp"

namespace vibrotrough::app {
namespace {

struct TheoryTraceArguments {
    TheoryOptions motion;
    RollingOption rolling;
    QuantityOptions count;
    Text output;
    Outputs outputs;
};

/// The trace as CSV with the columns time, phase and then all other numbers.
std::string as_csv(std::vector<theory::TraceSample> const& samples, bool si) {
    auto const& columns = theory::trace_columns();
    auto const row = [&](std::string const& phase, auto const& cell) {
        std::string line = fmt::format("{},{}", cell(columns.front()), phase);
        for (std::size_t i = 1; i < columns.size(); ++i) line += fmt::format(",{}", cell(columns[i]));
        return line + '\n';
    };
    std::string table = row("phase", [si](theory::TraceColumn const& c) { return si ? c.si_name : c.name; });
    for (theory::TraceSample const& s : samples)
        table += row(theory::to_string(s.kind), [&s](theory::TraceColumn const& c) { return s.*c.value; });
    return table;
}

struct Table {
    std::string text, mode;
};

/// The trace of a rolling layer, with the spin of its floor grains.
Table trace_rolling(TheoryTraceArguments const& options, theory::Conveyor const& input,
                    theory::RollingLaw const& law, int samples,
                    std::optional<theory::Machine> const& machine) {
    require_plastic(options.motion);
    if (auto const why = theory::outside_tested_range(input.point);
        why && !options.rolling.accepts_untested())
        throw core::InputError(*why + "; write other inputs, or accept that with --accept-untested");
    theory::RollingMotion const motion = theory::solve(theory::RollingLayer{input.point, law});
    if (!motion.period) {
        throw core::InputError(fmt::format("the motion has no period to trace: {}; change the inputs",
                                           to_string(motion.motion.outcome)));
    }
    double omega = 1, along = 1, normal = 1;
    if (machine) {
        double const beta = std::atan(input.point.tan_vibration_angle);
        omega = theory::angular_frequency(input.point, *machine);
        along = machine->amplitude * std::cos(beta);
        normal = machine->amplitude * std::sin(beta);
    }
    char const* const si_names =
        "t_s,phase,layer_velocity_m_per_s,spin_m_per_s,slip_m_per_s,gap_m,gap_rate_m_per_s,normal_force_n_"
        "per_kg,"
        "tangential_force_n_per_kg\n";
    std::string text =
        machine ? si_names : "t,phase,layer_velocity,spin,slip,gap,gap_rate,normal_force,tangential_force\n";
    for (theory::RollingSample const& s : theory::trace(motion, samples)) {
        text +=
            fmt::format("{},{},{},{},{},{},{},{},{}\n", s.t / omega, theory::to_string(s.kind),
                        omega * along * s.velocity, omega * along * s.spin,
                        omega * along * (s.velocity - s.spin), normal * s.gap, omega * normal * s.gap_rate,
                        omega * omega * normal * s.normal_force, omega * omega * along * s.tangential_force);
    }
    return {std::move(text), motion.motion.mode};
}

void write(TheoryTraceArguments const& options, int samples, Table const& table) {
    if (options.output) {
        core::write_file_atomically(*options.output, table.text);
        fmt::print("{} samples of mode {} written to {}\n", samples, table.mode, *options.output);
    } else {
        fmt::print("{}", table.text);
    }
}

void run_theory_trace(TheoryTraceArguments const& options) {
    int const samples = static_cast<int>(options.count.value("--samples").value_or(721));
    options.motion.tell_unusual();
    theory::Conveyor const input = options.motion.conveyor();
    auto const machine = options.motion.machine();
    auto const law = options.rolling.law();
    if (options.output)
        options.outputs.check("--output", *options.output,
                              law ? "phase,layer_velocity" : "phase,trough_velocity_x");
    if (law) {
        write(options, samples, trace_rolling(options, input, *law, samples, machine));
        return;
    }
    theory::ConveyorMotion const motion = theory::solve(input);
    if (motion.pieces.empty()) {
        throw core::InputError(fmt::format("the motion has no period to trace: {}; change the inputs",
                                           to_string(motion.motion.outcome)));
    }
    auto trace = theory::trace(motion, samples);
    if (machine) trace = theory::in_si_units(std::move(trace), input.point, *machine);
    write(options, samples, {as_csv(trace, machine.has_value()), motion.motion.mode});
}

}  // namespace

void add_theory_trace(CLI::App& theory, int& exit_code) {
    CLI::App* const command =
        theory.add_subcommand("trace", "Print velocities, forces and the gap over one period as CSV");
    auto const options = std::make_shared<TheoryTraceArguments>();
    options->motion.add_to(*command);
    options->rolling.add_to(*command);
    options->count.add_to(*command, {{"--samples"}});
    command->add_option("--output", options->output, "CSV file to write; default: standard output");
    options->outputs.add_to(*command);
    command->footer(
        std::string(
            R"(These are the curves of Fig. 6 of Sloot & Kruyt (1996). With the amplitude or stroke of the machine, or
its frequency, all columns are in SI units. Otherwise lengths along the trough (x) are in r cos(beta), lengths normal to
it (y) are in r sin(beta), and times are in 1/omega. Forces are per mass and do not include impacts. The column "phase" has one of the letters of
a mode. With --rolling-layer the columns are the velocity of the layer relative to the trough, the surface velocity of the
spinning floor grains (spin), their slip, the gap (negative in a soft landing) with its rate, and the two forces.

)") + mode_letters +
        R"(

Example:
  vibrotrough theory trace --throw-number 2.975 --vibration-angle "30 deg" --friction 0.3 \
      --output trace.csv)");
    command->callback([options, &exit_code] {
        run_theory_trace(*options);
        exit_code = all_well;
    });
}

}  // namespace vibrotrough::app
