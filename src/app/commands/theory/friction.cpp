#include "app/commands.hpp"
#include "app/commands/theory/options.hpp"
#include "app/exit_code.hpp"
#include "app/standard_streams.hpp"
#include "core/error.hpp"
#include "core/quantity.hpp"
#include "theory/friction_test.hpp"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::app {
namespace {

struct TheoryFrictionArguments {
    Text machine_number, displacement, uncertainty, friction, tan_inclination;
    bool json = false;
};

using Json = nlohmann::ordered_json;

std::string warning_for(std::string const& mode) {
    if (!theory::rests_within_cycle(mode)) return "";
    return fmt::format(
        "the mode is {}, not PN: the mass rests within the cycle, so static friction affects the result; "
        "shake harder (with a larger machine number)",
        mode);
}

/// "0.05:0.6:56": the curve of Fig. 8 as CSV.
void curve(std::string const& text, theory::ShakeTest const& test) {
    char const* const example = "0.05:0.6:56";
    auto const first = text.find(':'), second = text.rfind(':');
    if (first == second) {
        throw core::InputError(fmt::format(
            "--friction {}: a curve needs FROM:TO:COUNT; write for example --friction {}", text, example));
    }
    double const from = read_number_within("--friction", text.substr(0, first), example, 0, 1e6);
    double const to =
        read_number_within("--friction", text.substr(first + 1, second - first - 1), example, from, 1e6);
    int const count = read_count("--friction", text.substr(second + 1), example, 2, 1'000'000);
    fmt::print("friction,max_relative_displacement,mode\n");
    for (auto const& [mu, motion] : theory::shake_curve(test, from, to, count))
        fmt::print("{},{},{}\n", mu, motion.max_relative_displacement, motion.mode);
}

void forward(TheoryFrictionArguments const& options, theory::ShakeTest const& test) {
    if (options.friction->find(':') != std::string::npos) {
        curve(*options.friction, test);
        return;
    }
    double const mu = read_number_within("--friction", *options.friction, "0.3", 0, 1e6);
    theory::ShakeMotion const motion = theory::shake(test, mu);
    if (options.json) {
        Json const answer = {{"friction", mu},
                             {"machine_number", test.machine_number},
                             {"max_relative_displacement", motion.max_relative_displacement},
                             {"mode", motion.mode}};
        fmt::print("{}\n", answer.dump(2));
        return;
    }
    fmt::print("max relative displacement  {:.6f} r\nmode                       {}\n",
               motion.max_relative_displacement, motion.mode);
}

/// A slip in amplitudes, as a number. A length has a message of its own.
double read_slip(std::string const& text) {
    constexpr char const* option = "--max-relative-displacement";
    try {
        core::parse_quantity(text, "m");
    } catch (core::QuantityError const&) {
        return read_number_within(option, text, "1.5", 1e-9, 1000);
    }
    throw core::InputError(
        fmt::format("{} {}: is a length; divide it by the amplitude r and write the number without a unit, "
                    "for example {} 1.5",
                    option, text, option));
}

void inverse(TheoryFrictionArguments const& options, theory::ShakeTest const& test) {
    double const x = read_slip(*options.displacement);
    double const dx =
        options.uncertainty ? read_number_within("--uncertainty", *options.uncertainty, "0.05", 0, 1000) : 0;
    theory::FrictionEstimate const estimate = theory::friction_from_shake(test, x, dx);
    double const half = (estimate.high - estimate.low) / 2;
    std::string const warning = warning_for(estimate.mode);
    if (options.json) {
        Json const answer = {{"friction", estimate.friction},
                             {"friction_low", estimate.low},
                             {"friction_high", estimate.high},
                             {"friction_uncertainty", half},
                             {"mode", estimate.mode},
                             {"warning", warning},
                             {"machine_number", test.machine_number},
                             {"max_relative_displacement", x},
                             {"uncertainty", dx}};
        fmt::print("{}\n", answer.dump(2));
    } else {
        fmt::print("friction  {:.6f}", estimate.friction);
        if (dx > 0) fmt::print(" +- {:.6f}, from {:.6f} to {:.6f}", half, estimate.low, estimate.high);
        fmt::print("\nmode      {}\n", estimate.mode);
    }
    if (!warning.empty()) tell("vibrotrough: warning: {}\n", warning);
}

void run_theory_friction(TheoryFrictionArguments const& options) {
    std::string const k = required("--machine-number", options.machine_number, "1.5");
    theory::ShakeTest test{read_number_within("--machine-number", k, "1.5", 1e-3, 1e4)};
    if (options.tan_inclination) {
        test.tan_inclination =
            read_number_within("--tan-inclination", *options.tan_inclination, "0.01", -1000, 1000);
    }
    if (options.friction && options.displacement) {
        throw core::InputError(
            fmt::format("--friction {} and --max-relative-displacement {} are both given; write only one of "
                        "them",
                        *options.friction, *options.displacement));
    }
    if (!options.friction) required("--max-relative-displacement", options.displacement, "1.5");
    try {
        options.friction ? forward(options, test) : inverse(options, test);
    } catch (std::invalid_argument const& error) {
        throw core::InputError(fmt::format(
            "{}; write a displacement of 0 to 2 amplitudes, or another machine number", error.what()));
    }
}

}  // namespace

void add_theory_friction(CLI::App& theory, int& exit_code) {
    CLI::App* const command =
        theory.add_subcommand("friction", "Find the friction coefficient from a horizontal shake test");
    auto const options = std::make_shared<TheoryFrictionArguments>();
    command->add_option("--machine-number", options->machine_number, "K = omega^2 r / g of the shaking");
    command->add_option("--max-relative-displacement", options->displacement,
                        "Measured slip from peak to peak, in amplitudes r, from 0 to 2");
    command->add_option("--uncertainty", options->uncertainty,
                        "Uncertainty of that displacement, in amplitudes r");
    command->add_option("--friction", options->friction,
                        "Do the opposite: print the displacement for this mu, or for FROM:TO:COUNT as CSV");
    command->add_option("--tan-inclination", options->tan_inclination,
                        "tan of the inclination of the plate along the shaking; default: 0");
    command->add_flag("--json", options->json, "Print JSON");
    command->footer(
        std::string(
            R"(The test (Sloot & Kruyt 1996, section 6 and Fig. 8): shake a plate horizontally, and measure the largest
displacement of a box of grains relative to the plate, from peak to peak, in amplitudes r. Prints the friction
coefficient, its interval when an uncertainty is given, and the mode.

)") + mode_letters +
        R"(

Example:
  vibrotrough theory friction --machine-number 1.5 --max-relative-displacement 1.9 \
      --uncertainty 0.02

Example of a curve of displacement over friction:
  vibrotrough theory friction --machine-number 1.5 --friction 0.05:0.6:56)");
    command->callback([options, &exit_code] {
        run_theory_friction(*options);
        exit_code = all_well;
    });
}

}  // namespace vibrotrough::app
