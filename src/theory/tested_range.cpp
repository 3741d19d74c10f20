#include "theory/tested_range.hpp"

#include "theory/detail/ranges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace vibrotrough::theory {
namespace {

constexpr double rounding = 1e-9;

bool contains(Range const& range, double value) {
    return value >= range.low - rounding && value <= range.high + rounding;
}

std::string angle_text(double tangent) {
    std::array<char, 32> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "%.4g", std::atan(tangent) * 180 / std::numbers::pi);
    return buffer.data();
}

std::string tangent_text(char const* name, double tangent) {
    return std::string(name) + " = " + detail::short_text(tangent) + " (" + angle_text(tangent) + " deg)";
}

/// The ends are rounded for the reader.
std::string text(Range const& range) {
    std::array<char, 64> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "[%.4g, %.4g]", range.low, range.high);
    return buffer.data();
}

}  // namespace

std::optional<Range> tested_throw_numbers(double tan_inclination, std::optional<double> depth) {
    double const level_depth = tested_level.depth;
    TestedLayers const& far = depth.value_or(level_depth) < level_depth ? tested_shallow : tested_deep;
    double const on_slope = std::abs(tan_inclination) / tested_slopes.slope;
    double const at_depth = depth ? (*depth - level_depth) / (far.depth - level_depth) : 0;
    if (!(on_slope + at_depth <= 1 + rounding)) return {};
    auto const between = [&](double Range::*end) {
        double const level = tested_level.throw_number.*end;
        return level + on_slope * (tested_slopes.throw_number.*end - level) +
               at_depth * (far.throw_number.*end - level);
    };
    return Range{between(&Range::low), between(&Range::high)};
}

std::optional<std::string> outside_tested_range(PointMass const& p, std::optional<double> depth) {
    std::string const untested = "the rolling-layer law has not been tested at ";
    auto const outside = [&](std::string const& place, Range const& range) {
        return untested + place + ", outside " + text(range);
    };
    // Who gave an angle finds it behind its tangent.
    auto const outside_angle = [&](char const* name, double tangent, Range const& range) {
        return outside(tangent_text(name, tangent), range) + " (" + angle_text(range.low) + " to " +
               angle_text(range.high) + " deg)";
    };
    if (!contains(tested_tan_vibration_angle, p.tan_vibration_angle))
        return outside_angle("tan_vibration_angle", p.tan_vibration_angle, tested_tan_vibration_angle);
    if (!contains(tested_friction, p.friction))
        return outside("friction = " + detail::short_text(p.friction), tested_friction);
    Range const slopes{-tested_slopes.slope, tested_slopes.slope};
    if (!contains(slopes, p.tan_inclination))
        return outside_angle("tan_inclination", p.tan_inclination, slopes);
    Range const depths{tested_shallow.depth, tested_deep.depth};
    std::string const deep =
        depth ? "a depth in diameters of the grains = " + detail::short_text(*depth) : "";
    if (depth && !contains(depths, *depth)) return outside(deep, depths);
    auto const throw_numbers = tested_throw_numbers(p.tan_inclination, depth);
    std::string const where =
        (p.tan_inclination != 0 ? ", " + tangent_text("tan_inclination", p.tan_inclination) : "") +
        (depth ? ", " + deep : "");
    if (throw_numbers && contains(*throw_numbers, p.throw_number)) return {};
    return untested + "throw_number = " + detail::short_text(p.throw_number) + where +
           (throw_numbers ? ", where it has been for throw numbers in " + text(*throw_numbers) : "");
}

DriveSpace within_tested_range(DriveSpace space) {
    constexpr double degrees = 180 / std::numbers::pi;
    auto const narrowed = [](Range const& range, double low, double high, char const* name) {
        Range const common{std::max(range.low, low), std::min(range.high, high)};
        std::string const allowed =
            text({low * degrees, high * degrees}) + " deg, where the rolling-layer law has been tested";
        detail::require_range(common.low <= common.high, name, range.low * degrees, allowed.c_str());
        return common;
    };
    space.max_throw_number = std::min(space.max_throw_number, tested_level.throw_number.high);
    space.vibration_angle = narrowed(space.vibration_angle, std::atan(tested_tan_vibration_angle.low),
                                     std::atan(tested_tan_vibration_angle.high), "vibration angle in deg");
    double const slope = std::atan(tested_slopes.slope);
    space.inclination = narrowed(space.inclination, -slope, slope, "inclination in deg");
    return space;
}

double tested_excess(Drive const& drive, double gravity) {
    double const slope = std::tan(drive.inclination), throw_number = drive.throw_number(gravity);
    auto const tested = tested_throw_numbers(slope);
    if (!tested) return std::abs(slope) / tested_slopes.slope - 1;
    return std::max(1 - throw_number / tested->low, throw_number / tested->high - 1);
}

}  // namespace vibrotrough::theory
