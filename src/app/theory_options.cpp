#include "app/theory_options.hpp"

#include "core/error.hpp"
#include "core/quantity.hpp"

#include <charconv>
#include <cmath>
#include <numbers>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

constexpr double degree = std::numbers::pi / 180;

std::string const& required(std::string const& option, std::optional<std::string> const& text,
                            std::string const& example) {
    if (!text)
        throw InputError(fmt::format("{} is missing; write for example {} {}", option, option, example));
    return *text;
}

/// tan(angle) from exactly one of an angle with a unit and its tangent; `missing` when neither may be left
/// out.
double read_tangent(std::string const& name, std::optional<std::string> const& angle,
                    std::optional<std::string> const& tangent, double above_deg, std::string const& example) {
    std::string const option = "--" + name, tan_option = "--tan-" + name;
    double const tan_example = std::tan(30 * degree);
    if (angle && tangent) {
        throw InputError(fmt::format("{} {} and {} {} are both given; write only one of them", option, *angle,
                                     tan_option, *tangent));
    }
    if (tangent) return read_number(tan_option, *tangent, fmt::format("{:.3f}", tan_example));
    return std::tan(read_angle(option, required(option, angle, '"' + example + '"'), example, above_deg, 90));
}

void require_between(std::string const& option, std::string const& text, double value, double low,
                     double high, bool low_allowed, std::string const& example) {
    bool const good = (low_allowed ? value >= low : value > low) && value <= high;
    if (good) return;
    throw InputError(fmt::format("{} {}: must be {} {:g} and at most {:g}; write for example {} {}", option,
                                 text, low_allowed ? "at least" : "above", low, high, option, example));
}

}  // namespace

double read_number(std::string const& option, std::string const& text, std::string const& example) {
    double value = 0;
    char const* const end = text.data() + text.size();
    auto const [stop, failure] = std::from_chars(text.data() + (text.starts_with('+') ? 1 : 0), end, value);
    if (failure != std::errc() || stop != end || !std::isfinite(value)) {
        throw InputError(fmt::format("{} {}: '{}' is not a finite plain number; write for example {} {}",
                                     option, text, text, option, example));
    }
    return value;
}

double read_angle(std::string const& option, std::string const& text, std::string const& example,
                  double above_deg, double below_deg) {
    double angle = 0;
    try {
        angle = parse_quantity(text, "radian");
    } catch (QuantityError const& error) {
        throw InputError(fmt::format("{} {}: {}; write an angle with its unit, for example {} \"{}\"", option,
                                     text, error.what(), option, example));
    }
    if (!(angle > above_deg * degree && angle < below_deg * degree)) {
        throw InputError(
            fmt::format("{} {}: must lie between {:g} and {:g} degrees; write for example {} \"{}\"", option,
                        text, above_deg, below_deg, option, example));
    }
    return angle;
}

void PointMassOptions::add_to(CLI::App& command) {
    command.add_option("--throw-number", throw_number,
                       "Gamma = omega^2 r sin(beta) / (g cos(alpha)): above 1 the mass flies");
    command.add_option("--vibration-angle", vibration_angle,
                       "beta, between the direction of vibration and the trough, with its unit: \"30 deg\"");
    command.add_option("--tan-vibration-angle", tan_vibration_angle,
                       "tan(beta), instead of --vibration-angle");
    command.add_option("--inclination", inclination,
                       "alpha, uphill positive, with its unit: \"-3 deg\" (level when not given)");
    command.add_option("--tan-inclination", tan_inclination, "tan(alpha), instead of --inclination");
    command.add_option("--friction", friction, "mu, friction coefficient of the mass on the trough");
}

theory::PointMass PointMassOptions::read() const {
    theory::PointMass input{};
    auto const& gamma = required("--throw-number", throw_number, "2");
    input.throw_number = read_number("--throw-number", gamma, "2");
    require_between("--throw-number", gamma, input.throw_number, 0, 1e4, false, "2");
    input.tan_vibration_angle =
        read_tangent("vibration-angle", vibration_angle, tan_vibration_angle, 0, "30 deg");
    require_between("--tan-vibration-angle", tan_vibration_angle.value_or(""), input.tan_vibration_angle, 0,
                    1e6, false, "0.5");
    if (inclination || tan_inclination) {
        input.tan_inclination = read_tangent("inclination", inclination, tan_inclination, -90, "-3 deg");
        require_between("--tan-inclination", tan_inclination.value_or(""), input.tan_inclination, -1e6, 1e6,
                        true, "-0.05");
    }
    auto const& mu = required("--friction", friction, "0.3");
    input.friction = read_number("--friction", mu, "0.3");
    require_between("--friction", mu, input.friction, 0, 1e6, true, "0.3");
    return input;
}

}  // namespace vibrotrough::app
