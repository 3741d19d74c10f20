#include "app/commands.hpp"
#include "app/commands/theory/options.hpp"
#include "app/exit_code.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "theory/quantities.hpp"

#include <cmath>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

struct Options {
    TheoryOptions motion;
    Text samples, output, amplitude, gravity;
};

/// What the dimensionless values are multiplied with, and how the columns are then called.
struct Scales {
    double time = 1, speed_x = 1, speed_y = 1, acceleration_x = 1, acceleration_y = 1, length_x = 1,
           length_y = 1;
    char const* header =
        "time_rad,phase,trough_velocity_x,mass_velocity_x,trough_velocity_y,mass_velocity_y,trough_"
        "acceleration_x,"
        "trough_acceleration_y,relative_displacement,gap,normal_force,tangential_force\n";
};

/// With an amplitude: SI, forces per mass.
Scales read_scales(Options const& options, theory::PointMass const& point) {
    Scales scales;
    if (!options.amplitude) return scales;
    theory::Machine machine{.amplitude =
                                read_positive_quantity("--amplitude", *options.amplitude, "m", "6 mm")};
    if (options.gravity) {
        machine.gravity = read_positive_quantity("--gravity", *options.gravity, "m/s2", "9.81 m/s2");
    }
    double const omega = theory::angular_frequency(point, machine);
    double const tangent = point.tan_vibration_angle, cosine = 1 / std::hypot(1, tangent);
    scales.time = 1 / omega;
    scales.length_x = machine.amplitude * cosine;
    scales.length_y = machine.amplitude * cosine * tangent;
    scales.speed_x = omega * scales.length_x;
    scales.speed_y = omega * scales.length_y;
    scales.acceleration_x = omega * scales.speed_x;
    scales.acceleration_y = omega * scales.speed_y;
    scales.header =
        "time_s,phase,trough_velocity_x_m_per_s,mass_velocity_x_m_per_s,trough_velocity_y_m_per_s,"
        "mass_velocity_y_m_per_s,trough_acceleration_x_m_per_s2,trough_acceleration_y_m_per_s2,"
        "relative_displacement_m,gap_m,normal_force_n_per_kg,tangential_force_n_per_kg\n";
    return scales;
}

void run(Options const& options) {
    int const samples =
        options.samples ? read_count("--samples", *options.samples, "721", 2, 10'000'000) : 721;
    theory::Conveyor const input = options.motion.conveyor();
    Scales const scale = read_scales(options, input.point);
    theory::ConveyorMotion const motion = theory::solve(input);
    if (motion.pieces.empty()) {
        throw core::InputError(fmt::format("there is no cycle to trace: {}; change the inputs",
                                           to_string(motion.motion.outcome)));
    }
    std::string table = scale.header;
    for (theory::TraceSample const& s : theory::trace(motion, samples)) {
        table += fmt::format(
            "{},{},{},{},{},{},{},{},{},{},{},{}\n", s.t * scale.time, theory::to_string(s.kind),
            s.trough_vx * scale.speed_x, s.mass_vx * scale.speed_x, s.trough_vy * scale.speed_y,
            s.mass_vy * scale.speed_y, s.trough_ax * scale.acceleration_x, s.trough_ay * scale.acceleration_y,
            s.displacement * scale.length_x, s.gap * scale.length_y, s.normal_force * scale.acceleration_y,
            s.tangential_force * scale.acceleration_x);
    }
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
        theory.add_subcommand("trace",
                              "Print velocities, forces and gap over one period as CSV (Fig. 6 of the "
                              "paper). x: along, in r cos(beta); y:\n"
                              "normal, in r sin(beta); time in 1/omega; forces per mass, impacts apart.\n"
                              "Example: vibrotrough theory trace --throw-number 2.975 --vibration-angle \"30 "
                              "deg\" --friction 0.3 --output trace.csv");
    auto const options = std::make_shared<Options>();
    options->motion.add_to(*command, TheoryOptions::Extent::complete);
    command->add_option("--samples", options->samples, "Number of lines; 721 when not given");
    command->add_option("--amplitude", options->amplitude,
                        "r, half the stroke: \"6 mm\"; all columns are then SI");
    command->add_option("--gravity", options->gravity, "\"9.81 m/s2\" when not given");
    command->add_option("--output", options->output, "CSV file to write; printed when not given");
    command->callback([options, &exit_code] {
        run(*options);
        exit_code = all_well;
    });
}

}  // namespace vibrotrough::app
