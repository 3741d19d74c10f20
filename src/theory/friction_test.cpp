#include "theory/friction_test.hpp"

#include "theory/detail/ranges.hpp"
#include "theory/point_mass.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <boost/math/tools/toms748_solve.hpp>

namespace vibrotrough::theory {
namespace {

constexpr double tan_beta =
    1e-12;  // used instead of zero: the slides change by a relative amount of this size

PointMass point(ShakeTest const& test, double friction) {
    // Gamma = K sin(beta) / cos(alpha)
    double const gamma = test.machine_number * tan_beta * std::hypot(1, test.tan_inclination);
    return {gamma, tan_beta, test.tan_inclination, friction};
}

void check(ShakeTest const& test) {
    detail::require_range(test.machine_number >= 1e-3 && test.machine_number <= 1e4, "machine_number",
                          test.machine_number, "[1e-3, 1e4]");
    detail::require_range(std::abs(test.tan_inclination) <= 1e3, "tan_inclination", test.tan_inclination,
                          "[-1e3, 1e3]");
}

double displacement_at(ShakeTest const& test, double friction) {
    return shake(test, friction).max_relative_displacement;
}

/// mu for a displacement above 0, limited to the ends of the possible range.
double friction_at(ShakeTest const& test, double displacement) {
    double const slope = std::abs(test.tan_inclination);
    double const lowest = slope * (1 + 1e-6) + 1e-6;
    // With mu above K / cos(alpha) + |tan(alpha)| there is no slip.
    double const highest = test.machine_number * std::hypot(1, test.tan_inclination) + slope;
    auto const miss = [&](double mu) { return displacement_at(test, mu) - displacement; };
    if (lowest >= highest) return highest;
    double const most = miss(lowest);
    if (most <= 0) return lowest;
    std::uintmax_t iterations = 200;
    auto const root =
        boost::math::tools::toms748_solve(miss, lowest, highest, most, -displacement,
                                          boost::math::tools::eps_tolerance<double>(45), iterations);
    return (root.first + root.second) / 2;
}

}  // namespace

ShakeMotion shake(ShakeTest const& test, double friction) {
    check(test);
    Motion const motion = solve(point(test, friction));
    if (!motion.converged)
        throw std::invalid_argument("the shake test needs a friction coefficient larger than |tan(alpha)|");
    double largest = 0;
    for (Phase const& phase : motion.phases)
        largest = std::max(largest, std::abs(phase.relative_displacement));
    return {largest, motion.mode};
}

bool rests_within_cycle(std::string const& mode) {
    return mode != "PN";
}

FrictionEstimate friction_from_shake(ShakeTest const& test, double displacement, double uncertainty) {
    check(test);
    detail::require_range(displacement > 0 && displacement < 1e3, "max_relative_displacement", displacement,
                          "(0, 1000)");
    detail::require_range(uncertainty >= 0 && uncertainty < 1e3, "uncertainty", uncertainty, "[0, 1000)");
    FrictionEstimate estimate{friction_at(test, displacement), 0, {}, ""};
    if (std::abs(displacement_at(test, estimate.friction) - displacement) > 1e-6) {
        throw std::invalid_argument("no friction coefficient gives a max_relative_displacement of " +
                                    detail::short_text(displacement) + " amplitudes at machine_number " +
                                    detail::short_text(test.machine_number));
    }
    estimate.low = friction_at(test, displacement + uncertainty);
    if (displacement > uncertainty) estimate.high = friction_at(test, displacement - uncertainty);
    estimate.mode = shake(test, estimate.friction).mode;
    return estimate;
}

}  // namespace vibrotrough::theory
