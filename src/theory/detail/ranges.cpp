#include "theory/detail/ranges.hpp"

#include "theory/inputs.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

namespace vibrotrough::theory::detail {

std::string number_text(double value) {
    char text[32];
#ifdef __cpp_lib_to_chars
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
#else
    // The library of clang 14, with which the page is compiled for browsers, has no to_chars of a double.
    for (int digits = 1; digits < 17; ++digits) {
        std::snprintf(text, sizeof text, "%.*g", digits, value);
        if (std::strtod(text, nullptr) == value) return text;
    }
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
#endif
}

std::string short_text(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

void require_range(bool good, std::string_view name, double value, std::string_view range) {
    if (good) return;
    throw std::invalid_argument(std::string(name) + " = " + short_text(value) + " is outside its range " +
                                std::string(range));
}

namespace {

bool is_within(InputRow const& row, double value) {
    return value >= row.least && value <= row.most && (value == 0 || std::abs(value) >= row.least_but_zero);
}

std::string range_of(InputRow const& row) {
    bool const split = row.least_but_zero > 0;
    return (split ? "0 or [" : "[") + short_text(split ? row.least_but_zero : row.least) + ", " +
           short_text(row.most) + "]";
}

}  // namespace

void check_ranges(PointMass const& p) {
    require_range(p.throw_number > 0 && p.throw_number <= largest_throw_number, "throw_number",
                  p.throw_number, "(0, 100]");
    require_range(p.tan_vibration_angle > 0 && p.tan_vibration_angle <= 1e6, "tan_vibration_angle",
                  p.tan_vibration_angle, "(0, 1e6]");
    require_range(std::abs(p.tan_inclination) <= 1e6, "tan_inclination", p.tan_inclination, "[-1e6, 1e6]");
    require_range(p.friction == 0 || (p.friction >= 1e-6 && p.friction <= 1e6), "friction", p.friction,
                  "0 or [1e-6, 1e6]");
}

std::string inputs_text(PointMass const& p) {
    return "throw_number=" + number_text(p.throw_number) +
           " tan_vibration_angle=" + number_text(p.tan_vibration_angle) +
           " tan_inclination=" + number_text(p.tan_inclination) + " friction=" + number_text(p.friction);
}

void check_ranges(Conveyor const& c) {
    check_ranges(c.point);
    for (InputRow const& row : input_rows) {
        auto const value = value_in(c, row);
        if (value && !is_within(row, *value)) require_range(false, row.name, *value, range_of(row));
    }
    require_range(c.static_friction == 0 || c.static_friction >= c.point.friction, "static_friction",
                  c.static_friction, "[friction, 1e6]");
    for (auto const* harmonics : {&c.along, &c.normal}) {
        for (Harmonic const& h : *harmonics) {
            require_range(h.order >= 1 && h.order <= 100, "order", h.order, "[1, 100]");
            require_range(std::abs(h.amplitude) <= 100, "amplitude", h.amplitude, "[-100, 100]");
            require_range(std::abs(h.phase) <= 100, "phase", h.phase, "[-100, 100]");
        }
    }
    // The change of the velocity by friction within a radian: where it is near rounding, any motion seems to
    // repeat.
    EffectiveFriction const friction = effective_friction(c);
    double const effect =
        std::max({friction.kinetic_friction, friction.static_friction, friction.landing_friction}) *
        c.point.tan_vibration_angle / std::min(1.0, c.point.throw_number);
    require_range(effect == 0 || effect >= 5e-9, "friction * tan_vibration_angle / min(throw_number, 1)",
                  effect, "0 or [5e-9, inf)");
}

std::string inputs_text(Conveyor const& c) {
    auto const harmonics = [&](char const* name, std::vector<Harmonic> const& all) {
        std::string text;
        for (Harmonic const& h : all) {
            text += std::string(" ") + name + "=" + std::to_string(h.order) + "," + number_text(h.amplitude) +
                    "," + number_text(h.phase);
        }
        return text;
    };
    std::string text = inputs_text(c.point);
    for (InputRow const& row : input_rows) {
        if (auto const value = value_in(c, row))
            text.append(" ").append(row.name).append("=").append(number_text(*value));
    }
    return text + harmonics("along", c.along) + harmonics("normal", c.normal);
}

}  // namespace vibrotrough::theory::detail
