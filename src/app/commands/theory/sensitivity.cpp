#include "theory/sensitivity.hpp"

#include "app/commands.hpp"
#include "app/commands/theory/options.hpp"
#include "app/exit_code.hpp"
#include "core/error.hpp"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::app {
namespace {

struct TheorySensitivityArguments {
    TheoryOptions motion;
    bool json = false;
};

void run_theory_sensitivity(TheorySensitivityArguments const& options) {
    options.motion.tell_unusual();
    theory::Inputs const inputs = options.motion.given();
    require_complete(inputs);
    std::vector<theory::Sensitivity> answers;
    try {
        answers = theory::sensitivities(inputs);
    } catch (std::invalid_argument const& error) {
        throw core::InputError(fmt::format("{}; write other inputs", error.what()));
    }
    if (!options.json)
        fmt::print("{:<22} {:>12} {:>18} {:>22}\n", "input", "value", "d eta / d input",
                   "relative (elasticity)");
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (theory::Sensitivity const& s : answers) {
        json.push_back({{"input", theory::name_of(s.input)},
                        {"value", s.value},
                        {"derivative", s.derivative},
                        {"elasticity", s.elasticity}});
        if (options.json) continue;
        fmt::print("{:<22} {:>12.6g} {:>18.6g} {:>22.6g}\n", theory::name_of(s.input), s.value, s.derivative,
                   s.elasticity);
    }
    if (options.json) fmt::print("{}\n", json.dump(2));
}

}  // namespace

void add_theory_sensitivity(CLI::App& theory, int& exit_code) {
    CLI::App* const command =
        theory.add_subcommand("sensitivity", "Print how the velocity efficiency changes with each input");
    auto const options = std::make_shared<TheorySensitivityArguments>();
    options->motion.add_to(*command);
    command->add_flag("--json", options->json, "Print JSON");
    command->footer(
        R"(Prints one line per input: its value, the derivative of the velocity efficiency eta with respect to it,
and the relative derivative (elasticity): the change of eta in percent when the input changes by one percent.

Example:
  vibrotrough theory sensitivity --throw-number 2 --tan-vibration-angle 0.5 --friction 0.3)");
    command->callback([options, &exit_code] {
        run_theory_sensitivity(*options);
        exit_code = all_well;
    });
}

}  // namespace vibrotrough::app
