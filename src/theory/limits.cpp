#include "theory/limits.hpp"

#include "theory/detail/ranges.hpp"
#include "theory/efficiency.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>

namespace vibrotrough::theory {
namespace {

using std::numbers::pi;

/// Eq. 10 for a slide from omega t = d to e that starts from rest.
double slide_displacement(double factor, double sine, double d, double e) {
    double const h = e - d;
    return factor * (std::sin(d) - std::sin(e) + std::cos(d) * h - h * h * sine / 2);
}

}  // namespace

double throw_number_of_flight(double n) {
    detail::require_range(n >= 0 && n <= 1000, "flight_number", n, "[0, 1000]");
    double const d = 2 * pi * n;
    if (d < 1e-3)
        return std::hypot(d / 4, 1);  // d/4 (1 + O(d^2)): its square is below the rounding error of 1
    return std::hypot((std::cos(d) + d * d / 2 - 1) / (d - std::sin(d)), 1);
}

Optimum best_throw_number(double tan_vibration_angle, double tan_inclination, double friction) {
    if (std::abs(tan_inclination) >= friction) {
        throw std::invalid_argument(
            "|tan_inclination| >= friction: the mass runs away, so there is no best throw number");
    }
    EfficiencySolver solver;
    auto const loss = [&](double gamma) {
        return -solver({gamma, tan_vibration_angle, tan_inclination, friction}).velocity_efficiency;
    };
    double const lowest = 0.1, highest = std::hypot(pi, 1), step = (highest - lowest) / 2000;
    double best = lowest, least = loss(lowest);
    for (int i = 1; i <= 2000; ++i) {
        double const gamma = lowest + i * step, value = loss(gamma);
        if (value < least) best = gamma, least = value;
    }
    // At a kink the maximum is narrower than a parabola: Brent's method then falls back on golden sections.
    auto const found = boost::math::tools::brent_find_minima(loss, std::max(best - step, lowest),
                                                             std::min(best + step, highest), 40);
    return -found.second > -least ? Optimum{found.first, -found.second} : Optimum{best, -least};
}

double best_throw_number_small_angle() {
    // f(d) = tan d - D / (D^2/2 - 1) on (0, pi/2) changes from negative to positive.
    auto const f = [](double d) {
        double const flight = 2 * pi - d;
        return std::sin(d) * (flight * flight / 2 - 1) - std::cos(d) * flight;
    };
    std::uintmax_t iterations = 100;
    auto const root = boost::math::tools::toms748_solve(
        f, 0.01, pi / 2, boost::math::tools::eps_tolerance<double>(52), iterations);
    return 1 / std::sin((root.first + root.second) / 2);
}

std::optional<PnMotion> pn_motion(PointMass const& input) {
    detail::check_ranges(input);
    double const mu_tan = input.friction * input.tan_vibration_angle;
    double const weight = input.tan_vibration_angle / input.throw_number;
    if (input.throw_number > 1 || mu_tan >= 1 || !(input.friction > std::abs(input.tan_inclination)))
        return std::nullopt;
    double const s1 = (input.friction + input.tan_inclination) * weight / (1 + mu_tan);   // Eq. 7
    double const s3 = -(input.friction - input.tan_inclination) * weight / (1 - mu_tan);  // Eq. 8
    if (!(s1 < 1 && s3 > -1)) return std::nullopt;
    double const c = 2 * pi / (1 - s1 / s3);
    double const y = (c - 2 * pi) * s3 / (2 * std::sin(c / 2));
    if (std::abs(y) > 1) return std::nullopt;
    double const start = pi - std::asin(y) - c / 2, end = start + c;
    // Each slide must be able to start where the other ends.
    if (std::sin(start) < s1 || std::sin(end) > s3) return std::nullopt;
    double const forward = slide_displacement(1 + mu_tan, s1, start, end);
    double const backward = slide_displacement(1 - mu_tan, s3, end, start + 2 * pi);
    return PnMotion{start, end, forward, backward, (forward + backward) / (2 * pi)};
}

double small_angle_efficiency(double tan_inclination, double friction) {
    detail::require_range(friction > 0 && friction <= 1e6, "friction", friction, "(0, 1e6]");
    detail::require_range(std::abs(tan_inclination) <= friction, "tan_inclination", tan_inclination,
                          "[-friction, friction]");
    return -std::sin(pi * tan_inclination / (2 * friction));
}

double pn_machine_number(double friction) {
    return friction * std::sqrt(1 + pi * pi / 4);
}

Limits limits(double tan_vibration_angle, double tan_inclination, double friction) {
    double const whole = throw_number_of_flight(1);
    return {.whole_cycle_throw_number = whole,
            .whole_cycle_efficiency = std::sqrt(1 - 1 / (whole * whole)),  // cos(delta_F), after Eq. 19
            .best_throw_number_small_angle = best_throw_number_small_angle(),
            .best = best_throw_number(tan_vibration_angle, tan_inclination, friction),
            .small_angle_efficiency = small_angle_efficiency(tan_inclination, friction),
            .pn_machine_number = pn_machine_number(friction)};
}

}  // namespace vibrotrough::theory
