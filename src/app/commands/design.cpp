#include "app/commands/command.hpp"
#include "app/commands/design_options.hpp"
#include "app/design_verification.hpp"
#include "app/learning.hpp"
#include "app/outputs.hpp"
#include "app/python.hpp"
#include "learn/design_campaign.hpp"
#include "learn/design_report.hpp"
#include "learn/driven_design.hpp"

#include <stdexcept>

#include <unistd.h>

namespace vibrotrough::app {
namespace {

struct DesignArguments {
    DesignOptions task;
    std::string campaign, page, python, project, revision;
    bool json = false, verify = false;
    Outputs outputs;
    Text budget;
    QuantityOptions counts;
    VerificationOptions verification;
};

learn::DesignTask read_task(DesignArguments const& options) {
    learn::DesignTask task = options.task.task();
    bool const is_simulated = options.verify || !options.campaign.empty();
    auto const asks = [&](std::string const& model) {
        return std::ranges::find(options.task.models, model) != options.task.models.end();
    };
    bool const matters = is_simulated || asks("atlas") || asks("rolling-layer") || asks("surface") ||
                         !options.task.surface.empty() || options.task.material_chooses_model();
    if (task.rolling_friction && !matters)
        throw core::InputError(
            "--rolling-friction: the point mass does not know it; write --model rolling-layer, --verify or "
            "--campaign as well, or leave it out");
    if (!options.verify) return task;
    if (auto const& why = options.task.material.why_unknown())
        throw core::InputError(
            fmt::format("--verify: its layers are of dry spheres of one size, and {}", *why));
    if (task.machine && task.machine->exciter)
        throw core::InputError(
            "--verify: proposes machines with other strokes than the exciter gives; leave --exciter out and "
            "give its stroke by --stroke");
    if (!task.grain_diameter)
        throw core::InputError(
            "--verify: simulates the layer and needs the size of its grains; write "
            "--grain-diameter \"3 mm\"");
    if (!task.rolling_friction)
        throw core::InputError(
            "--verify: simulates the layer and needs its rolling friction; write --rolling-friction "
            "0.1, or 0 for spheres that roll freely");
    if (std::ranges::find(options.task.models, "surface") != options.task.models.end() ||
        !options.task.surface.empty())
        throw core::InputError(
            "--verify: its layers are not those of the surface's campaign; simulate the machine with that "
            "campaign's grains, or verify another model");
    double const least = learn::least_simulated_depth * *task.grain_diameter;
    if (task.depth.high < least)
        throw core::InputError(fmt::format(
            "--verify: simulates layers of {:g} diameters or more, {:.3g} mm here; allow a deeper layer with "
            "--layer-depth",
            learn::least_simulated_depth, 1e3 * least));
    task.depth.low = std::max(task.depth.low, least);
    return task;
}

/// The machine that the models propose, whose stroke follows from the exciter if there is one.
learn::ChosenDesign find_machine(DesignArguments const& options, learn::DesignTask const& task) {
    int round = 0;
    auto const find = [&](learn::DesignTask const& one) {
        ++round;
        if (::isatty(STDERR_FILENO) == 1 && !options.verification.quiet)
            fmt::print(stderr, "looking for the machine{}; this takes some seconds\n",
                       round == 1 ? "" : fmt::format(", with the stroke under its layer, {}", round));
        return learn::ChosenDesign{one, propose_machine(one)};
    };
    if (!task.machine || !task.machine->exciter) return find(task);
    try {
        return learn::design_with_exciter(task, find);
    } catch (std::invalid_argument const& error) {
        throw core::InputError(fmt::format("--exciter: {}", error.what()));
    }
}

/// Verifies the design unless it was not asked for; tells how.
VerifiedDesign find_design(DesignArguments const& options, learn::DesignTask task) {
    if (!options.verify) {
        learn::ChosenDesign found = find_machine(options, task);
        return {std::move(found.task), std::move(found.design), {}};
    }
    VerificationOptions how = options.verification;
    if (options.budget) how.budget = read_core_time(*options.budget);
    how.jobs = static_cast<int>(options.counts.value("--jobs").value_or(how.jobs));
    return verify_design(task, how);
}

void write_campaign(DesignArguments const& options, learn::DesignTask const& task,
                    learn::RiskDesign const& design) {
    std::string const& file = options.campaign;
    if (auto const why = learn::why_no_campaign(task, design)) {
        tell("no campaign is written: {}\n", *why);
        return;
    }
    options.outputs.write_editable("--campaign", file, learn::design_campaign(task, design, {}));
    tell("campaign written: {0}; next: vibrotrough check {0}\n", core::shell_word(file));
}

int run_design(DesignArguments options) {
    if (options.task.posterior) options.outputs.inputs.emplace_back(*options.task.posterior);
    if (!options.page.empty()) options.outputs.check("--page", options.page, page_mark);
    options.task.take_material();
    VerifiedDesign found = find_design(options, read_task(options));
    if (found.is_interrupted) return interrupted;
    settle_load(found.task, found.design);
    learn::DesignTask const& task = found.task;
    learn::RiskDesign const& design = found.design;
    if (!options.campaign.empty()) write_campaign(options, task, design);
    if (!options.page.empty()) {
        auto data = learn::design_page_data(task, design);
        data["project"] = options.project;
        data["revision"] = options.revision;
        if (options.verify) data["verification"] = learn::verification_sentence(task, found.verification);
        write_decision_page(data, "design", options.page, options.python);
    }
    if (options.json) {
        auto json = learn::design_json(task, design);
        if (options.verify) json["verification"] = learn::verification_json(found.verification);
        fmt::print("{}\n", json.dump(2));
    } else {
        if (options.verify) fmt::print("{}\n", learn::verification_text(task, found.verification));
        fmt::print("{}", learn::design_text(task, design));
    }
    bool const is_good = !options.verify || found.verification.verdict == learn::Verdict::verified;
    return design.feasible && is_good ? all_well : some_cases_failed;
}

void add_verification(CLI::App& command, DesignArguments& options) {
    CLI::Option* const verify = command.add_flag("--verify", options.verify,
                                                 "Simulate the machine at its own depth, with grains of "
                                                 "--grain-diameter and --rolling-friction; correct "
                                                 "the models with the result, and repeat until both agree");
    verify->group("Verification");
    auto const add = [&](CLI::Option* option) { option->needs(verify)->group("Verification"); };
    add(command
            .add_option(
                "--budget", options.budget,
                "Core time of all simulations; default: \"1 core-hours\". A machine that would exceed "
                "it is not begun")
            ->type_name("TIME"));
    add(command
            .add_option("--output", options.verification.output,
                        "Folder of the simulations, from which a later call goes on")
            ->type_name("DIR")
            ->capture_default_str());
    options.counts.add_to(command, {{"--jobs"}}, "Verification");
    add(command
            .add_option("--liggghts", options.verification.engine,
                        "The LIGGGHTS program; default: liggghts on the PATH")
            ->type_name("PATH"));
    add(command.add_flag("--quiet", options.verification.quiet, "Show no progress"));
}

constexpr char const* help =
    R"(Answers: which stroke, speed and angle carry this mass flow on this trough, and how sure is that?

1. The friction is never known exactly. Give it with its standard uncertainty (0.3+-0.03), or give the speeds that you
measured on another machine to 'vibrotrough theory calibrate' and its file to --posterior.

2. No model is exact either: each misses the truth by its discrepancy. Speed and mass flow therefore have a
distribution, and the layer is made so deep that the mass flow is reached with the stated confidence. What the point
mass and the rolling-layer law miss is known from simulated layers (validation/model_errors); where none tells it, for
example because the layer is deeper than any of them, or nobody says how large its grains are (--grain-diameter), the
answer begins with "Not tested" and has no probability.

3. Every limit is kept by the machine as it is printed (rounded to what a workshop sets), the landing speed at
every friction in the central 99.7 % of its distribution (three standard deviations on each side).

4. Four models can be asked. The point mass is the theory of Sloot and Kruyt. Between throw numbers 1.2 and
2.3, layers of grains that roll are conveyed up to twice as fast as it says: the rolling-layer law describes
these. The atlas is what simulated layers of spheres say, with an interval (see 'vibrotrough predict'); what
it does not know of the grains (rolling friction, friction, restitution) is part of its uncertainty, as the
rolling friction is of the law's. A surface is what your own simulated campaign says. Landing speed, power and mode are always those of the point mass.
With --grain-diameter and without --model the atlas decides, and the others stand beside it; for grains that do not
roll (--rolling-friction 0.5 or more) the point mass does. One model decides by the material, never by whether it
carries the mass flow: a wider range never gives a worse machine, but for a percent. Where the atlas knows no
layer within the limits, the point mass proposes a machine, without a probability.

The rules of thumb beside the answer know neither friction nor depth. --campaign writes the campaign file that
checks the design with grains: the same machine, depth, width and grains. What you did not give of the grains is in
the middle of what was simulated.

The answer ranks what is uncertain by what it leaves open of the mass flow: what to measure first. With
--trough-mass it tells the exciter that is needed, and with --exciter the stroke follows from it.

5. Where no machine carries the mass flow so surely, the answer says how wide a trough would, or how many side by
side. Where the limits exclude every machine, each one that alone would have to give way is named, with the value.

6. --verify simulates what the models propose: the machine at its own depth, at the median of the friction and at
the ends of its central 95 %. The models are corrected with what the layers say, and the next machine is proposed,
until a machine's simulation agrees with what was promised of it and its mass flow is reached so surely. Of the grains
their diameter and rolling friction are yours; the rest is assumed, as machine_N.toml in the folder says.

A range is "LOW to HIGH"; a single value fixes the quantity. With several speeds or strokes of the drive
(--rpm 960,1450,2900, --poles 4,6,8 --mains 50, --stroke "6,8,10 mm") a machine is found for each; the best by the
objective is printed, and what the others gave.

Examples:
  vibrotrough design --mass-flow "12 t/h" --bulk-density "600 kg/m3" --width "300 mm" \
      --length "3 m" --friction 0.3+-0.03 --grain-diameter "5 mm" --machine-number 4
  vibrotrough theory calibrate speeds.csv --free friction --posterior friction.json
  vibrotrough design --mass-flow "12 t/h" --bulk-density "600 kg/m3" --width "300 mm" \
      --posterior friction.json --model point-mass,rolling-layer --objective least-machine-number \
      --page design.html --campaign check_design.toml
  vibrotrough design --mass-flow "12 t/h" --bulk-density "600 kg/m3" --width "400 mm" \
      --friction 0.3 --rpm 960 --machine-number 4 --grain-diameter "3.5 mm" --rolling-friction 0.1 \
      --model rolling-layer --verify --budget "2 core-hours")";

}  // namespace

void add_design(CLI::App& program, int& exit_code) {
    CLI::App* const command = program.add_subcommand(
        "design", "Find stroke, speed, angle and layer depth for a mass flow, and how sure that is");
    auto const options = std::make_shared<DesignArguments>();
    options->task.add_to(*command);
    add_text(*command, "--campaign", options->campaign,
             "Write the campaign that checks the design with grains into this file", "FILE");
    add_text(*command, "--page", options->page,
             "Write a page of one screen about the design into this HTML file", "FILE");
    add_text(*command, "--project", options->project, "Name of the project on this page", "TEXT");
    add_text(*command, "--revision", options->revision, "Its revision, for example \"B\"", "TEXT");
    options->outputs.add_to(*command);
    add_python(*command, options->python);
    add_verification(*command, *options);
    command->add_flag("--json", options->json, "Print JSON");
    command->footer(help);
    command->callback([options, &exit_code] { exit_code = run_design(*options); });
}

}  // namespace vibrotrough::app
