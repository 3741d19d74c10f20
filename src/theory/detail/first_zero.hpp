#pragma once

#include "theory/errors.hpp"

#include <algorithm>
#include <cmath>

// Internal to the room.
namespace vibrotrough::theory::detail {

struct Sample {
    double value, rate;
    double bend;  ///< no |second derivative| exceeds it within the next `reach`
    double reach = HUGE_VAL;
};

/// The first time in [t, end] at which a function that is above zero (or rises from zero) at t reaches zero;
/// `end` when it does not. Every step is certified: with |f''| <= bend, f stays above zero for h = (f' +
/// sqrt(f'^2 + 2 bend f)) / bend. Next to a zero the steps are Newton's, so it converges quadratically, from
/// the left.
template <class Function>
double first_zero(Function const& f, double t, double end) {
    double moment = 1e-9;  // rad
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
            step = std::max(step, moment);  // it leaves zero with hardly a rate: look a moment later
            moment *= 2;
        }
        t += step;
    }
    if (t < end) throw PhaseError("the end of a phase was not found");
    return end;
}

}  // namespace vibrotrough::theory::detail
