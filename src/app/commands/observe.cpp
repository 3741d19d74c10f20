#include "app/commands/command.hpp"
#include "app/observing.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "campaign/state/notes.hpp"
#include "campaign/state/observables.hpp"
#include "campaign/state/overview.hpp"

namespace vibrotrough::app {
namespace {

struct ObserveArguments {
    std::string folder, file, allowed, python;
    std::vector<std::string> only;
    bool examples = false;
    bool json = false;
};

/// One line for a number, or for a curve where to find it.
std::string line_of(store::Observable const& observable, store::ObservedCase const& one,
                    std::string const& name) {
    std::string text = fmt::format("  {}: ", name);
    if (observable.is_number()) {
        auto const& [mean, half_width, steadiness] = one.values.front();
        text += mean ? fmt::format("{:.5g}", *mean) : "unknown";
        if (mean)
            text += half_width ? fmt::format(" +- {:.2g}", *half_width) : ", with an unbounded interval";
        if (steadiness != "steady") text += fmt::format(", {}", steadiness);
    } else {
        text += fmt::format("{} points", one.at.size());
    }
    return text + fmt::format("; {} packing{} of {} cycles, {} of them cut as start-up\n",
                              one.packings.size(), one.packings.size() == 1 ? "" : "s",
                              one.discarded + one.measured, one.discarded);
}

/// A case by what distinguishes it.
std::string name_in(campaign::Plan const& plan, std::string const& id) {
    auto const found = std::ranges::find(plan.cases, id, &campaign::PlannedCase::id);
    return found == plan.cases.end() || found->label.empty() ? id : found->label;
}

void print_text(std::vector<Observed> const& observed, campaign::Plan const& plan,
                std::string const& folder) {
    bool is_of_one_packing = false;
    for (auto const& [observable, missing, left_out] : observed) {
        if (!missing.empty()) continue;
        std::string const over =
            observable.is_number() ? "" : fmt::format(" over {} [{}]", observable.over, observable.over_unit);
        fmt::print("{} [{}]{}: {}\n", observable.name, observable.unit, over, observable.meaning);
        for (store::ObservedCase const& one : observable.cases) {
            fmt::print("{}", line_of(observable, one, name_in(plan, one.id)));
            is_of_one_packing = is_of_one_packing || one.packings.size() == 1;
        }
    }
    if (is_of_one_packing)
        fmt::print(
            "an interval is unbounded where one packing was measured, because it does not tell how packings "
            "differ; frame_packings = \"all\" keeps the frames of all\n");
    std::string const word = core::shell_word(folder);
    fmt::print("kept in {}/{} and campaign.h5; numbers are columns of: vibrotrough compare {}\n", folder,
               campaign::observables_file, word);
}

int run_observe(ObserveArguments const& options) {
    if (options.examples) {
        fmt::print("{}", shipped_observables().text);
        return all_well;
    }
    if (options.folder.empty())
        throw core::InputError(
            "DIR is missing, the folder of a campaign's results; see 'vibrotrough observe --help'");
    campaign::Plan const plan = campaign::open_plan(options.folder);
    ObservableSource const source =
        options.file.empty() ? shipped_observables() : read_observable_source(options.file, options.allowed);
    Observing const found = observe(plan, source, options.only, options.python);
    if (found.exit_code != all_well) return found.exit_code;
    std::vector<store::Observable> measured;
    for (auto const& [observable, missing, left_out] : found.observed) {
        if (!missing.empty()) {
            if (found.observed.size() > 1)
                tell("vibrotrough: {} is not measured: {}\n", observable.name, missing);
            continue;
        }
        measured.push_back(observable);
        if (!left_out.empty())
            tell("vibrotrough: {} is not measured in {}, where no packing has what it needs\n",
                 observable.name, fmt::join(left_out, ", "));
    }
    if (measured.empty()) {
        Observed const& first = found.observed.front();
        throw core::InputError(
            fmt::format("{} cannot be measured: {}", first.observable.name, first.missing));
    }
    campaign::write_observables(plan.folder, measured);
    campaign::write_campaign_file(plan);
    if (options.json) {
        fmt::print("{}", campaign::to_json(measured));
    } else {
        print_text(found.observed, plan, options.folder);
    }
    return all_well;
}

}  // namespace

void add_observe(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<ObserveArguments>();
    CLI::App* const command = program.add_subcommand(
        "observe", "Measure quantities of your own, functions in Python, with the program's statistics");
    command->add_option("DIR", options->folder, "Folder of the campaign's results, as given to run --output");
    command->add_option("FILE", options->file,
                        "Your functions in Python; without it those that --examples prints");
    add_text(*command, "--allow-python", options->allowed,
             "Run this file, which must be FILE: it can do anything that you can, so read it first", "FILE");
    add_repeated(*command, "--only", options->only,
                 "Measure only the function of this name; repeat the option for several", "NAME");
    command->add_flag("--examples", options->examples,
                      "Print the file of the functions that ship with the program, and exit");
    command->add_flag("--json", options->json, "Print what was measured as JSON for scripts");
    add_python(*command, options->python, "numpy and h5py");
    command->footer(
        R"(A file of your own begins like this. The function gets one cycle of a packing after the other and returns a number:

  import numpy as np
  import vibrotrough

  @vibrotrough.observable(unit="m")
  def height_of_the_layer(cycle):
      '''Mean height of the grains above the trough.'''
      return np.mean([frame.heights.mean() for frame in cycle.frames])

A frame has positions, velocities, spins, radii, types and ids of the grains, as arrays of NumPy in SI units. Frames are
there where the campaign file asks for them (frames_per_cycle and frame_packings under [output]), contacts with their
forces where it says contacts = true. 'help(vibrotrough.observable)' in Python explains curves, functions of a whole packing
and files that your templates write; 'vibrotrough observe --examples' prints complete ones.

The program cuts the start-up that it has cut from the velocity efficiency, and more where MSER asks for it, and makes the mean
over packings and its interval as those of the efficiency. "drifting" means that the cycles kept still change in one direction,
"branching" that packings that started slow and fast differ. What was measured is kept in observables.json of the campaign's
folder, with the text of your file, and from there in campaign.h5, 'compare' and 'archive'. It is left aside when the
result of a case changes: give the command again.

Examples:
  vibrotrough observe runs/demo
  vibrotrough observe --examples > my_observables.py
  vibrotrough observe runs/demo my_observables.py --allow-python my_observables.py)");
    command->callback([options, &exit_code] { exit_code = run_observe(*options); });
}

}  // namespace vibrotrough::app
