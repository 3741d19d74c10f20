#pragma once

#include "theory/errors.hpp"

#include <algorithm>
#include <cmath>

// Internal to this room.
namespace vibrotrough::theory::detail {

/// A function at one point, with bounds on its behaviour to the right.
struct Sample {
    double value, rate;
    double bend;  ///< upper bound of |second derivative| within the next `reach`
    double reach = HUGE_VAL;
};

/// The first time in [t, end] at which a function that is positive (or rises from zero) at t reaches zero;
/// `end` if it does not. No step can skip a zero: with |f''| <= bend, f stays positive for h = (f' +
/// sqrt(f'^2 + 2 bend f)) / bend. Close to a zero these are Newton steps, so that the method converges
/// quadratically from the left.
template <class Function>
double first_zero(Function const& f, double t, double end) {
    double least_step = 1e-9;  // rad
    for (int i = 0; i < 1000000 && t < end; ++i) {
        Sample const s = f(t);
        double const value = s.value > 0 ? s.value : 0;
        if (value == 0 && s.rate <= 0 && i > 0) return t;
        double const root = std::sqrt(s.rate * s.rate + 2 * s.bend * value);
        double step = s.rate < 0 ? 2 * value / (root - s.rate) : (s.rate + root) / s.bend;
        if (s.bend == 0 && s.rate >= 0) step = s.reach;
        step = std::min(step, s.reach);
        double const least = 4e-16 * (1 + std::abs(t));
        if (step < least && s.rate < 0) return t;
        if (step < least || (value == 0 && i > 0)) {
            step = std::max(step, least_step);  // f leaves zero with almost no slope: go a little further
            least_step *= 2;
        }
        t += step;
    }
    if (t < end) throw PhaseError("the end of a phase was not found");
    return end;
}

}  // namespace vibrotrough::theory::detail
