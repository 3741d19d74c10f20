#include "theory/design.hpp"

#include "theory/detail/ranges.hpp"
#include "theory/map.hpp"
#include "theory/tested_range.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>

namespace vibrotrough::theory {
namespace {

using std::numbers::pi;
constexpr double near_limit = 1e-3;

/// The design of a drive without its verdict.
Design design_at(DesignLimits const& l, Drive const& drive, PointSolver& solver) {
    Design d{};
    d.frequency = drive.frequency;
    d.amplitude = drive.amplitude;
    d.vibration_angle = drive.vibration_angle;
    d.inclination = drive.inclination;
    d.machine_number = drive.machine_number(l.gravity);
    d.throw_number = drive.throw_number(l.gravity);
    Inputs inputs;
    inputs.set(Input::throw_number, std::min(d.throw_number, largest_throw_number));
    inputs.set(Input::tan_vibration_angle, std::tan(drive.vibration_angle));
    inputs.set(Input::tan_inclination, std::tan(drive.inclination));
    inputs.set(Input::friction, l.friction);
    Efficiency const e = solver(inputs);
    d.velocity_efficiency = e.velocity_efficiency;
    d.conveying_speed = e.velocity_efficiency * drive.trough_speed();
    d.mass_flow = l.bulk_density * l.layer_height * l.layer_width * d.conveying_speed;
    d.mode = to_string(e.mode);
    return d;
}

void check(DesignLimits const& l) {
    check(l.space());
    detail::require_range(l.friction > 0 && l.friction <= 1e3, "friction", l.friction, "(0, 1000]");
    bool const layer = l.bulk_density > 0 && l.layer_height > 0 && l.layer_width > 0;
    detail::require_range(l.min_mass_flow == 0 || (l.min_mass_flow > 0 && layer), "min_mass_flow",
                          l.min_mass_flow, "[0, inf), with bulk density, layer height and width given");
}

std::vector<std::string> active_limits(DesignLimits const& l, Design const& d) {
    std::vector<std::string> active;
    auto const text = [](double value) {
        std::array<char, 32> buffer{};
        std::snprintf(buffer.data(), buffer.size(), "%.6g", value);
        return std::string(buffer.data());
    };
    double const degrees = 180 / pi;
    auto const in_degrees = [&](Range const& r) { return Range{r.low * degrees, r.high * degrees}; };
    auto const check_range = [&](char const* name, double value, Range const& r, char const* unit) {
        double const slack = near_limit * std::max({std::abs(r.low), std::abs(r.high), r.high - r.low});
        if (r.high - r.low < 1e-12) return;  // a fixed value, not a limit
        if (value > r.high - slack) active.push_back(std::string(name) + " <= " + text(r.high) + unit);
        if (value < r.low + slack) active.push_back(std::string(name) + " >= " + text(r.low) + unit);
    };
    if (d.machine_number > l.max_machine_number * (1 - near_limit)) {
        active.push_back("machine_number <= " + text(l.max_machine_number));
    }
    if (d.throw_number > l.max_throw_number * (1 - near_limit)) {
        active.push_back("throw_number <= " + text(l.max_throw_number));
    }
    check_range("frequency", d.frequency, l.frequency, " Hz");
    check_range("amplitude", 1e3 * d.amplitude, {1e3 * l.amplitude.low, 1e3 * l.amplitude.high}, " mm");
    check_range("vibration_angle", d.vibration_angle * degrees, in_degrees(l.vibration_angle), " deg");
    check_range("inclination", d.inclination * degrees, in_degrees(l.inclination), " deg");
    if (l.min_mass_flow > 0 && d.mass_flow < l.min_mass_flow * (1 + near_limit)) {
        active.push_back("mass_flow >= " + text(l.min_mass_flow) + " kg/s");
    }
    return active;
}

}  // namespace

DriveSpace DesignLimits::space() const {
    return {frequency,          amplitude,        vibration_angle, inclination,
            max_machine_number, max_throw_number, gravity};
}

double steepest_slope(double friction) {
    return std::atan(max_friction_used * friction);
}

Range with_friction_margin(Range inclination, double friction) {
    constexpr double degrees = 180 / pi;
    double const steepest = steepest_slope(friction);
    // The flattest inclination that is allowed, with its sign, as it was given.
    double const flattest = inclination.low > 0    ? inclination.low
                            : inclination.high < 0 ? inclination.high
                                                   : 0;
    std::string const range = "up to " + detail::short_text(steepest * degrees) +
                              " deg, where tan(alpha) is 95 % of the friction coefficient";
    detail::require_range(std::abs(flattest) <= steepest, "inclination in deg", flattest * degrees,
                          range.c_str());
    return {std::max(inclination.low, -steepest), std::min(inclination.high, steepest)};
}

Design fastest_design(DesignLimits const& requested) {
    check(requested);
    DesignLimits limits = requested;
    limits.inclination = with_friction_margin(limits.inclination, limits.friction);
    if (limits.rolling) {
        DriveSpace const tested = within_tested_range(limits.space());
        limits.max_throw_number = tested.max_throw_number;
        limits.vibration_angle = tested.vibration_angle;
        limits.inclination = tested.inclination;
    }
    PointSolver solver(limits.rolling);
    auto const speed = [&](Drive const& drive) { return design_at(limits, drive, solver).conveying_speed; };
    std::vector<DriveFunction> excesses;
    if (limits.rolling)
        excesses.emplace_back([&](Drive const& drive) { return tested_excess(drive, limits.gravity); });
    auto const drive = best_drive(limits.space(), speed, excesses);
    if (!drive) throw std::invalid_argument("no machine within the limits has a steady speed");
    Design design = design_at(limits, *drive, solver);
    design.feasible = std::isfinite(design.conveying_speed) && design.conveying_speed > 0 &&
                      design.mass_flow >= limits.min_mass_flow * (1 - 1e-9);
    design.active_limits = active_limits(limits, design);
    return design;
}

std::vector<Sensitivity> sensitivities_at(Design const& design, DesignLimits const& limits) {
    Inputs inputs;
    inputs.set(Input::throw_number, design.throw_number);
    inputs.set(Input::tan_vibration_angle, std::tan(design.vibration_angle));
    inputs.set(Input::tan_inclination, std::tan(design.inclination));
    inputs.set(Input::friction, limits.friction);
    return sensitivities(inputs, limits.rolling);
}

}  // namespace vibrotrough::theory
