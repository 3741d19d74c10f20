#include "app/commands/command.hpp"
#include "app/commands/theory/options.hpp"
#include "theory/friction_test.hpp"

namespace vibrotrough::app {
namespace {

struct TheoryFrictionArguments {
    QuantityOptions quantities;
    bool json = false;
};

std::string warning_for(std::string const& mode) {
    if (!theory::rests_within_cycle(mode)) return "";
    return fmt::format(
        "the mode is {}, not PN: the mass rests within the cycle, so static friction affects the result; "
        "shake harder (with a larger machine number)",
        mode);
}

void forward(TheoryFrictionArguments const& options, theory::ShakeTest const& test) {
    double const mu = options.quantities.required("--friction");
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

void inverse(TheoryFrictionArguments const& options, theory::ShakeTest const& test) {
    double const x = options.quantities.required("--max-relative-displacement");
    double const dx = options.quantities.value("--uncertainty").value_or(0);
    theory::FrictionEstimate const estimate = theory::friction_from_shake(test, x, dx);
    std::optional<double> half;
    if (estimate.high) half = (*estimate.high - estimate.low) / 2;
    std::string const warning = warning_for(estimate.mode);
    if (options.json) {
        Json const answer = {{"friction", estimate.friction},
                             {"friction_low", estimate.low},
                             {"friction_high", number_or_null(estimate.high)},
                             {"friction_uncertainty", number_or_null(half)},
                             {"mode", estimate.mode},
                             {"warning", warning},
                             {"machine_number", test.machine_number},
                             {"max_relative_displacement", x},
                             {"uncertainty", dx}};
        fmt::print("{}\n", answer.dump(2));
    } else {
        fmt::print("friction  {:.6f}", estimate.friction);
        if (half && dx > 0)
            fmt::print(" +- {:.6f}, from {:.6f} to {:.6f}", *half, estimate.low, *estimate.high);
        if (!half) fmt::print(", {:.6f} or more, because the box may not have slid at all", estimate.low);
        fmt::print("\nmode      {}\n", estimate.mode);
    }
    if (!warning.empty()) tell("vibrotrough: warning: {}\n", warning);
}

void run_theory_friction(TheoryFrictionArguments const& options) {
    QuantityOptions const& given = options.quantities;
    theory::ShakeTest test{given.required("--machine-number")};
    test.tan_inclination = given.value("--tan-inclination").value_or(0);
    given.refuse_both("--friction", "--max-relative-displacement");
    bool const is_forward = given.has("--friction");
    try {
        is_forward ? forward(options, test) : inverse(options, test);
    } catch (std::invalid_argument const& error) {
        throw core::InputError(fmt::format("{}; write a {}", error.what(),
                                           is_forward ? "larger --friction" : "smaller displacement"));
    }
}

}  // namespace

void add_theory_friction(CLI::App& theory, int& exit_code) {
    CLI::App* const command =
        theory.add_subcommand("friction", "Find the friction coefficient from a horizontal shake test");
    auto const options = std::make_shared<TheoryFrictionArguments>();
    options->quantities.add_to(*command,
                               {{"--machine-number", ", of the shaking"},
                                {"--max-relative-displacement"},
                                {"--uncertainty", "", "Uncertainty of that displacement, in amplitudes r"},
                                {"--friction", "", "Do the opposite: print the displacement for this mu"},
                                {"--tan-inclination", " of the plate along the shaking; default: 0"}});
    command->add_flag("--json", options->json, "Print JSON");
    command->footer(
        std::string(
            R"(The test (Sloot & Kruyt 1996, section 3.5 and Fig. 8): shake a plate horizontally, and measure the largest
displacement of a box of grains relative to the plate, from peak to peak, in amplitudes r. Prints the friction
coefficient, its interval when an uncertainty is given, and the mode.

)") + mode_letters +
        R"(

Example:
  vibrotrough theory friction --machine-number 1.5 --max-relative-displacement 1.9 \
      --uncertainty 0.02)");
    command->callback([options, &exit_code] {
        run_theory_friction(*options);
        exit_code = all_well;
    });
}

}  // namespace vibrotrough::app
