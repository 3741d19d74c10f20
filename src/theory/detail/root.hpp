#pragma once

#include "theory/detail/instant.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

#include <boost/math/tools/roots.hpp>
#include <boost/math/tools/toms748_solve.hpp>

// The ends of phases as roots. Internal to this module.
namespace vibrotrough::theory::detail {

/// A function at one time and its first two derivatives.
using Derivatives = std::tuple<double, double, double>;

/// Halley's last step, which leaves an error of its cube: that is below rounding.
inline constexpr double root_step = 3e-6;

/// The zero between low and high of a function that is positive before it, but for low itself, and negative
/// after it: Halley's method from a guess, and TOMS 748 where that leads nowhere, such as beside the place
/// where the function is flat.
template <class Function>
double falling_zero(Function const& f, double low, double high, double guess) {
    double value = 0, rate = 0, bend = 0;  // where it was evaluated last
    auto const noting = [&](double at) {
        Derivatives const all = f(at);
        std::tie(value, rate, bend) = all;
        return all;
    };
    auto const is_close = [&] {
        return rate < 0 && std::abs(value) * std::max(-rate, std::abs(bend)) <= root_step * rate * rate;
    };
    double t = guess > low && guess < high ? guess : low + (high - low) / 2;
    noting(t);
    // Where the guess is good, the first step is the last one, and Boost's care would cost more than the
    // step.
    double const next = t - 2 * value * rate / (2 * rate * rate - value * bend);
    if (next >= low && next <= high) {
        if (is_close()) return next;
        t = next;
    }
    try {
        for (int i = 0; i < 4 && high > low; ++i) {
            std::uintmax_t steps = 20;
            t = boost::math::tools::halley_iterate(noting, t, low, high, 20, steps);
            if (is_close()) return t;
            if (!(rate < 0)) break;
        }
    } catch (boost::math::evaluation_error const&) {
        // The first steps went away from the zero.
    }
    auto const value_at = [&](double at) { return std::get<0>(f(at)); };
    double at_low = value_at(low), at_high = value_at(high);
    if (!(at_high < 0)) return high;
    while (!(at_low > 0)) {  // it is zero there and rises
        t = low + (high - low) / 2;
        if (!(t > low && t < high)) return low;
        double const there = value_at(t);
        (there > 0 ? low : high) = t;
        (there > 0 ? at_low : at_high) = there;
    }
    std::uintmax_t steps = 200;
    auto const zero = boost::math::tools::toms748_solve(value_at, low, high, at_low, at_high,
                                                        boost::math::tools::eps_tolerance<double>(), steps);
    return zero.second;
}

/// A time beside one whose sine and cosine are known.
inline Instant instant_at(double t, Instant const& known) {
    double const d = t - known.t, half = d * d / 2;
    if (std::abs(d) > root_step) return Instant::at(t);
    return {t, known.sine * (1 - half) + known.cosine * d, known.cosine * (1 - half) - known.sine * d};
}

}  // namespace vibrotrough::theory::detail
