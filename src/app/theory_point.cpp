#include "app/commands.hpp"
#include "app/exit_code.hpp"
#include "app/theory_options.hpp"
#include "theory/point_mass.hpp"

#include <cmath>
#include <memory>
#include <numbers>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::app {
namespace {

struct Options {
    PointMassOptions point;
    bool json = false;
};

using Json = nlohmann::ordered_json;

/// A speed without bound has no number in JSON: null.
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

void print_json(theory::PointMass const& input, theory::Motion const& motion) {
    Json const answer = {{"velocity_efficiency", finite_or_null(motion.velocity_efficiency)},
                         {"mode", motion.mode},
                         {"phases", phases_as_json(motion)},
                         {"flight_number", motion.flight_number},
                         {"period_cycles", motion.period_cycles},
                         {"converged", motion.converged},
                         {"outcome", theory::to_string(motion.outcome)},
                         {"throw_number", input.throw_number},
                         {"machine_number", theory::machine_number(input)},
                         {"tan_vibration_angle", input.tan_vibration_angle},
                         {"tan_inclination", input.tan_inclination},
                         {"friction", input.friction}};
    fmt::print("{}\n", answer.dump(2));
}

void print_text(theory::PointMass const& input, theory::Motion const& motion) {
    fmt::print("throw number         {:.6g}\n", input.throw_number);
    fmt::print("machine number       {:.6g}\n", theory::machine_number(input));
    fmt::print("velocity efficiency  {:.6f}   mean relative velocity / (omega r cos(beta))\n",
               motion.velocity_efficiency);
    fmt::print("outcome              {}\n", theory::to_string(motion.outcome));
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

}  // namespace

void add_theory_point(CLI::App& theory, int& exit_code) {
    CLI::App* const command = theory.add_subcommand(
        "point",
        "Solve one point-mass motion with plastic landing (Sloot & Kruyt 1996): how it slides, rests and "
        "flies,\n"
        "and how fast it is conveyed.\n"
        "Example: vibrotrough theory point --throw-number 2 --vibration-angle \"30 deg\" --friction 0.23");
    auto const options = std::make_shared<Options>();
    options->point.add_to(*command);
    command->add_flag("--json", options->json, "Print JSON; angles in omega t, displacements in r cos(beta)");
    command->callback([options, &exit_code] {
        theory::PointMass const input = options->point.read();
        theory::Motion const motion = theory::solve(input);
        options->json ? print_json(input, motion) : print_text(input, motion);
        exit_code = all_well;
    });
}

}  // namespace vibrotrough::app
