#include "app/commands/command.hpp"
#include "app/commands/theory/options.hpp"

#include <cstdio>

namespace vibrotrough::app {
namespace {

char const* const option_name = "--rolling-layer";
char const* const example = "torque=0.5,dry_torque=0.04";
void set(theory::RollingLaw& law, std::string const& part) {
    auto const equals = part.find('=');
    std::string const name = part.substr(0, equals);
    if (equals == std::string::npos) {
        throw core::InputError(fmt::format("{} {}: needs NAME=VALUE; write for example {} {}", option_name,
                                           part, option_name, example));
    }
    std::string const text = part.substr(equals + 1);
    bool const endless = text == "inf" && (name == "torque" || name == "stiffness");
    double const value = endless ? theory::rigid : read_number(option_name, text, example);
    if (theory::set_constant(law, name, value)) return;
    throw core::InputError(fmt::format("{} {}: '{}' is not a constant; write one of {}", option_name, part,
                                       name, fmt::join(theory::rolling_constants(), ", ")));
}

}  // namespace

void RollingOption::add_to(CLI::App& command) {
    option_ =
        command
            .add_option(
                option_name, text_,
                "Solve a layer of grains that roll on the trough instead of a point mass. Without a value: "
                "the "
                "published constants; with NAME=VALUE,... others: torque (c, 0.61), dry_torque (mu_i, 0.02), "
                "spin_inertia (I, 0.10), stiffness (kappa, 14, inf: rigid landing), damping (zeta, 2.2)")
            ->expected(0, 1)
            ->type_name("[NAME=VALUE,...]");
    command.add_flag("--accept-untested", accepts_untested_,
                     "Also answer where the rolling-layer law has not been tested; the answer is marked");
}

std::optional<theory::RollingLaw> RollingOption::law() const {
    if (option_ == nullptr || option_->count() == 0) return {};
    theory::RollingLaw law;
    std::size_t from = 0;
    while (from < text_.size()) {
        auto const comma = std::min(text_.find(',', from), text_.size());
        set(law, text_.substr(from, comma - from));
        from = comma + 1;
    }
    try {
        theory::RollingLayerSolver const checked(law);
    } catch (std::invalid_argument const& error) {
        throw core::InputError(
            fmt::format("{} {}: {}; write another value", option_name, text_, error.what()));
    }
    return law;
}

void tell_withheld(std::size_t count, std::size_t all) {
    if (count == 0) return;
    fmt::print(
        stderr,
        "warning: {} of {} points are outside the range in which the rolling-layer law has been tested; "
        "their answers are withheld, and --accept-untested gives them (see validation/rolling_layer)\n",
        count, all);
}

}  // namespace vibrotrough::app
