#include "theory/detail/common/input_check.hpp"

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

void require_range(bool good, char const* name, double value, char const* range) {
    if (good) return;
    throw std::invalid_argument(std::string(name) + " = " + short_text(value) + " is outside its range " +
                                range);
}

void check_ranges(PointMass const& p) {
    require_range(p.throw_number > 0 && p.throw_number <= 1e4, "throw_number", p.throw_number, "(0, 1e4]");
    require_range(p.tan_vibration_angle > 0 && p.tan_vibration_angle <= 1e6, "tan_vibration_angle",
                  p.tan_vibration_angle, "(0, 1e6]");
    require_range(std::abs(p.tan_inclination) <= 1e6, "tan_inclination", p.tan_inclination, "[-1e6, 1e6]");
    require_range(p.friction >= 0 && p.friction <= 1e6, "friction", p.friction, "[0, 1e6]");
}

std::string inputs_text(PointMass const& p) {
    return "throw_number=" + number_text(p.throw_number) +
           " tan_vibration_angle=" + number_text(p.tan_vibration_angle) +
           " tan_inclination=" + number_text(p.tan_inclination) + " friction=" + number_text(p.friction);
}

}  // namespace vibrotrough::theory::detail
