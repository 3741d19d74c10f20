#include "app/commands.hpp"
#include "app/commands/calibration_options.hpp"
#include "app/commands/theory/options.hpp"
#include "app/exit_code.hpp"
#include "core/error.hpp"
#include "learn/calibration_report.hpp"
#include "learn/point_mass_model.hpp"

#include <algorithm>
#include <map>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

struct TheoryCalibrateArguments {
    std::string file;
    CalibrationOptions shared;
    std::vector<std::string> fixed;
};

int run_theory_calibrate(TheoryCalibrateArguments const& options) {
    auto const speeds = options.shared.read_speeds(options.file);
    std::map<std::string, double> fixed;
    for (std::string const& text : options.fixed) {
        auto const [name, value] = split_setting("--fix", text, "friction=0.3");
        if (!fixed.emplace(name, read_number("--fix", value, "friction=0.3")).second)
            throw core::InputError(fmt::format("--fix {}: {} is fixed twice; name it once", text, name));
    }
    learn::SpeedModel const model = learn::point_mass_model(options.shared.free, fixed, speeds);
    auto const parameters = options.shared.parameters(learn::point_mass_parameters());
    for (auto const& [name, value] : fixed) {
        inference::Bounds const usual =
            std::ranges::find(learn::point_mass_parameters(), name, &learn::FreeParameter::name)->prior;
        if (!(value >= std::min(usual.low, 0.0) && value <= 2 * usual.high))
            throw core::InputError(fmt::format("--fix {}={:g}: must be at most {:g}; write a value within",
                                               name, value, 2 * usual.high));
    }
    learn::Calibration const calibration =
        learn::calibrate(model, parameters, speeds, options.shared.settings());
    print_calibration(options.shared, calibration, {"the point mass"});
    return calibration.converged ? all_well : some_cases_failed;
}

}  // namespace

void add_theory_calibrate(CLI::App& theory, int& exit_code) {
    CLI::App* const command =
        theory.add_subcommand("calibrate", "Find friction and other quantities from measured speeds");
    auto const options = std::make_shared<TheoryCalibrateArguments>();
    command->add_option("file", options->file, "CSV file of measured speeds")->required()->type_name("FILE");
    options->shared.add_to(*command);
    command
        ->add_option(
            "--fix", options->fixed,
            "Value of a quantity that is known, for example restitution=0.1; repeat the option for several")
        ->type_name("NAME=VALUE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command->footer(
        R"(The quantities that can be free or fixed are friction, static_friction, landing_friction, restitution,
inclination and vibration_angle (both in degrees).

)" + std::string(calibration_help) +
        R"(

Example:
  vibrotrough theory calibrate speeds.csv --free friction,inclination --plot corner.png)");
    command->callback([options, &exit_code] { exit_code = run_theory_calibrate(*options); });
}

}  // namespace vibrotrough::app
