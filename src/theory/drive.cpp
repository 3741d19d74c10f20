#include "theory/drive.hpp"

#include "theory/detail/ranges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace vibrotrough::theory {
namespace {

using std::numbers::pi;
constexpr double most_friction_used = 0.95;

}  // namespace

double Drive::angular_frequency() const {
    return 2 * pi * frequency;
}
double Drive::trough_speed() const {
    return angular_frequency() * amplitude * std::cos(vibration_angle);
}
double Drive::machine_number(double gravity) const {
    return angular_frequency() * angular_frequency() * amplitude / gravity;
}
double Drive::throw_number(double gravity) const {
    return machine_number(gravity) * std::sin(vibration_angle) / std::cos(inclination);
}

void check(DriveSpace const& s) {
    auto const range = [](Range const& r, double least, double most, char const* name, char const* text) {
        detail::require_range(r.low >= least && r.low <= r.high && r.high <= most, name, r.high, text);
    };
    range(s.frequency, 1e-3, 1e4, "frequency", "from low to high within [0.001, 10000] Hz");
    range(s.amplitude, 1e-7, 10, "amplitude", "from low to high within [1e-7, 10] m");
    range(s.vibration_angle, 1e-6, pi / 2 - 1e-6, "vibration_angle", "from low to high within (0, pi/2)");
    range(s.inclination, -pi / 2 + 1e-6, pi / 2 - 1e-6, "inclination",
          "from low to high within (-pi/2, pi/2)");
    detail::require_range(s.max_machine_number > 0 && s.max_machine_number <= 1e4, "max_machine_number",
                          s.max_machine_number, "(0, 1e4]");
    detail::require_range(s.max_throw_number > 0 && s.max_throw_number <= 1e4, "max_throw_number",
                          s.max_throw_number, "(0, 1e4]");
}

double excess(DriveSpace const& space, Drive const& drive) {
    return std::log(std::max(drive.machine_number(space.gravity) / space.max_machine_number,
                             drive.throw_number(space.gravity) / space.max_throw_number));
}

double steepest_slope(double friction) {
    return std::atan(most_friction_used * friction);
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

}  // namespace vibrotrough::theory
