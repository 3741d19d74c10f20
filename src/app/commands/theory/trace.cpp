#include "app/commands.hpp"
#include "app/commands/theory/options.hpp"
#include "app/exit_code.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "theory/quantities.hpp"

#include <memory>
#include <optional>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

struct Options {
    TheoryOptions motion;
    Text samples, output, amplitude, gravity;
};

/// The machine; none without an amplitude.
std::optional<theory::Machine> read_machine(Options const& options) {
    if (!options.amplitude) return {};
    theory::Machine machine{.amplitude =
                                read_positive_quantity("--amplitude", *options.amplitude, "m", "6 mm")};
    if (options.gravity)
        machine.gravity = read_positive_quantity("--gravity", *options.gravity, "m/s2", "9.81 m/s2");
    return machine;
}

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

void run(Options const& options) {
    int const samples =
        options.samples ? read_count("--samples", *options.samples, "721", 2, 10'000'000) : 721;
    theory::Conveyor const input = options.motion.conveyor();
    auto const machine = read_machine(options);
    theory::ConveyorMotion const motion = theory::solve(input);
    if (motion.pieces.empty()) {
        throw core::InputError(fmt::format("the motion has no period to trace: {}; change the inputs",
                                           to_string(motion.motion.outcome)));
    }
    auto trace = theory::trace(motion, samples);
    if (machine) trace = theory::in_si_units(std::move(trace), input.point, *machine);
    std::string const table = as_csv(trace, machine.has_value());
    if (options.output) {
        core::write_file_atomically(*options.output, table);
        fmt::print("{} samples of mode {} written to {}\n", samples, motion.motion.mode, *options.output);
    } else {
        fmt::print("{}", table);
    }
}

}  // namespace

void add_theory_trace(CLI::App& theory, int& exit_code) {
    CLI::App* const command =
        theory.add_subcommand("trace", "Print velocities, forces and the gap over one period as CSV");
    auto const options = std::make_shared<Options>();
    options->motion.add_to(*command);
    command->add_option("--samples", options->samples, "Number of lines; default: 721");
    command->add_option("--amplitude", options->amplitude,
                        "r, half the stroke, for example \"6 mm\"; all columns are then in SI units");
    command->add_option("--gravity", options->gravity, "Default: \"9.81 m/s2\"");
    command->add_option("--output", options->output, "CSV file to write; default: standard output");
    command->footer(
        std::string(
            R"(These are the curves of Fig. 6 of Sloot & Kruyt (1996). Without --amplitude, lengths along the trough
(x) are in r cos(beta), lengths normal to it (y) are in r sin(beta), and times are in 1/omega. Forces are per mass and
do not include impacts. The column "phase" has one of the letters of
a mode.

)") + mode_letters +
        R"(

Example:
  vibrotrough theory trace --throw-number 2.975 --vibration-angle "30 deg" --friction 0.3 \
      --output trace.csv)");
    command->callback([options, &exit_code] {
        run(*options);
        exit_code = all_well;
    });
}

}  // namespace vibrotrough::app
