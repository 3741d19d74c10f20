#include "app/commands.hpp"
#include "app/commands/common_options.hpp"
#include "app/commands/design_options.hpp"
#include "app/decision_page.hpp"
#include "app/exit_code.hpp"
#include "app/standard_streams.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/shell.hpp"
#include "learn/design_report.hpp"

#include <memory>
#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::app {
namespace {

struct DesignArguments {
    DesignOptions task;
    std::string campaign, page, python;
    bool json = false;
};

int run_design(DesignArguments const& options) {
    learn::DesignTask const task = options.task.task();
    learn::RiskDesign design;
    try {
        design = learn::design_with_risk(task);
    } catch (std::invalid_argument const& error) {
        throw core::InputError(fmt::format("no machine fits: {}; widen the limits", error.what()));
    }
    if (!options.campaign.empty()) {
        core::write_file_atomically(
            options.campaign, learn::design_campaign(task, design, task.grain_diameter.value_or(0.003)));
        tell("campaign written: {0}; next: vibrotrough check {0}\n", core::shell_word(options.campaign));
    }
    if (!options.page.empty())
        write_decision_page(learn::design_page_data(task, design), "design", options.page, options.python);
    if (options.json) {
        fmt::print("{}\n", learn::design_json(task, design).dump(2));
    } else {
        fmt::print("{}", learn::design_text(task, design));
    }
    return design.feasible ? all_well : some_cases_failed;
}

constexpr char const* help =
    R"(Answers: which stroke, speed and angle carry this mass flow on this trough, and how sure is that?

1. The friction is never known exactly. Give it with its standard uncertainty, or give the speeds that you
measured on another machine to 'vibrotrough theory calibrate' and its file to --posterior.

2. No model is exact either: each misses the truth by its discrepancy. Speed and mass flow therefore have a
distribution, and the layer is made so deep that the mass flow is reached with the stated confidence. What the point
mass and the rolling-layer law miss is known from simulated layers (validation/model_errors); where none tells it, for
example because the layer is deeper than any of them (--grain-diameter), the answer begins with "Not tested" and has
no probability.

3. Every limit is kept by the machine as it is printed (rounded to what a workshop sets), the landing speed at
every friction in the central 99.7 % of its distribution (three standard deviations on each side).

4. Four models can be asked. The point mass is the theory of Sloot and Kruyt. Between throw numbers 1.2 and
2.3, layers of grains that roll are conveyed up to twice as fast as it says: the rolling-layer law describes
these. The atlas is what simulated layers of spheres say, with an interval (see 'vibrotrough predict'); what
it does not know of the grains (rolling friction, friction, restitution) is part of its uncertainty. A surface
is what your own simulated campaign says. Landing speed, power and mode are always those of the point mass.

The rules of thumb beside the answer know neither friction nor depth. --campaign writes the campaign file that
checks the design with grains; its grains are assumed, so put in what you know of yours.

5. Where no machine carries the mass flow so surely, the answer says how wide a trough would, or how many side by
side. Where the limits exclude every machine, each one that alone would have to give way is named, with the value.

A range is "LOW to HIGH"; a single value fixes the quantity. With several speeds of the drive (--rpm 960,1450,2900)
a machine is found for each; the best by the objective is printed, and what the others gave.

Exit codes:
    0  the mass flow is reached
    1  it is not: the fastest machine within the limits is printed; or the error of the model is
       not known there, so that no probability is given
    2  the input is wrong, or no machine keeps all limits
    3  something is missing: Python with its modules, for --page

Examples:
  vibrotrough design --mass-flow "12 t/h" --bulk-density "600 kg/m3" --width "300 mm" \
      --length "3 m" --friction 0.3 --friction-uncertainty 0.03 --machine-number 4 \
      --layer-depth "5 mm to 40 mm"
  vibrotrough theory calibrate speeds.csv --free friction --posterior friction.json
  vibrotrough design --mass-flow "12 t/h" --bulk-density "600 kg/m3" --width "300 mm" \
      --posterior friction.json --model point-mass,rolling-layer --objective least-machine-number \
      --page design.html --campaign check_design.toml)";

}  // namespace

void add_design(CLI::App& program, int& exit_code) {
    CLI::App* const command = program.add_subcommand(
        "design", "Find stroke, speed, angle and layer depth for a mass flow, and how sure that is");
    auto const options = std::make_shared<DesignArguments>();
    options->task.add_to(*command);
    command
        ->add_option("--campaign", options->campaign,
                     "Write the campaign that checks the design with grains into this file")
        ->type_name("FILE");
    command
        ->add_option("--page", options->page,
                     "Write a page of one screen about the design into this HTML file")
        ->type_name("FILE");
    add_python(*command, options->python);
    command->add_flag("--json", options->json, "Print JSON");
    command->footer(help);
    command->callback([options, &exit_code] { exit_code = run_design(*options); });
}

}  // namespace vibrotrough::app
