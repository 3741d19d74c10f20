#include "app/commands.hpp"
#include "app/exit_code.hpp"
#include "app/theory_options.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "theory/quantities.hpp"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

struct Options {
    TheoryOptions motion;
    Text samples, output;
};

void run(Options const& options) {
    int const samples =
        options.samples ? read_count("--samples", *options.samples, "721", 2, 10'000'000) : 721;
    theory::ConveyorMotion const motion = theory::solve(options.motion.conveyor());
    if (motion.pieces.empty()) {
        throw InputError(fmt::format("there is no cycle to trace: {}; change the inputs",
                                     to_string(motion.motion.outcome)));
    }
    std::string table =
        "time_rad,phase,trough_velocity_x,mass_velocity_x,trough_velocity_y,mass_velocity_y,trough_"
        "acceleration_x,"
        "trough_acceleration_y,relative_displacement,gap,normal_force,tangential_force\n";
    for (theory::TraceSample const& s : theory::trace(motion, samples)) {
        table += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", s.t, theory::to_string(s.kind),
                             s.trough_vx, s.mass_vx, s.trough_vy, s.mass_vy, s.trough_ax, s.trough_ay,
                             s.displacement, s.gap, s.normal_force, s.tangential_force);
    }
    if (options.output) {
        write_file_atomically(*options.output, table);
        fmt::print("{} samples of mode {} written to {}\n", samples, motion.motion.mode, *options.output);
    } else {
        fmt::print("{}", table);
    }
}

}  // namespace

void add_theory_trace(CLI::App& theory, int& exit_code) {
    CLI::App* const command =
        theory.add_subcommand("trace",
                              "Print velocities, forces and gap over one period as CSV (Fig. 6 of the "
                              "paper). x: along, in r cos(beta); y:\n"
                              "normal, in r sin(beta); time in 1/omega; forces per mass, impacts apart.\n"
                              "Example: vibrotrough theory trace --throw-number 2.975 --vibration-angle \"30 "
                              "deg\" --friction 0.3 --output trace.csv");
    auto const options = std::make_shared<Options>();
    options->motion.add_to(*command, TheoryOptions::Extent::complete);
    command->add_option("--samples", options->samples, "Number of lines; 721 when not given");
    command->add_option("--output", options->output, "CSV file to write; printed when not given");
    command->callback([options, &exit_code] {
        run(*options);
        exit_code = all_well;
    });
}

}  // namespace vibrotrough::app
