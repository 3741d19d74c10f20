#pragma once

#include "theory/errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

// Internal to this room.
namespace vibrotrough::theory::detail {

/// A function at one point, with bounds on its behaviour to the right.
struct Sample {
    double value, rate;
    double bend;  ///< upper bound of |second derivative| within the next `reach`
    double reach = HUGE_VAL;
};

/// How far a function stays positive for certain: with |f''| <= bend it does for h = (f' + sqrt(f'^2 + 2 bend
/// f)) / bend. Close to a zero these are Newton steps.
inline double safe_step(Sample const& s) {
    double const value = s.value > 0 ? s.value : 0;
    double const root = std::sqrt(s.rate * s.rate + 2 * s.bend * value);
    double const step = s.rate < 0 ? 2 * value / (root - s.rate) : (s.rate + root) / s.bend;
    return std::min(s.bend == 0 && s.rate >= 0 ? s.reach : step, s.reach);
}

/// A zero, and which of several functions it belongs to (-1: none reaches zero before the end).
struct FirstZero {
    double t;
    int which;
};

/// The first time in [t, end] at which one of N functions that are positive (or rise from zero) at t reaches
/// zero. No step can skip a zero (safe_step()), so that the method converges quadratically from the left.
/// @param f  gives an array of N samples at a time
template <std::size_t N, class Functions>
FirstZero first_of_zeros(Functions const& f, double t, double end) {
    double least_step = 1e-9;  // rad
    for (int i = 0; i < 1000000 && t < end; ++i) {
        double shortest = HUGE_VAL;
        double const least = 4e-16 * (1 + std::abs(t));
        bool at_zero = false;
        auto const samples = f(t);
        for (std::size_t k = 0; k < N; ++k) {
            Sample const& s = samples[k];
            bool const zero = !(s.value > 0);
            if (zero && s.rate <= 0 && i > 0) return {t, static_cast<int>(k)};
            double const step = safe_step(s);
            if (step < least && s.rate < 0) return {t, static_cast<int>(k)};
            at_zero = at_zero || (zero && i > 0);
            shortest = std::min(shortest, step);
        }
        if (shortest < least || at_zero) {
            shortest =
                std::max(shortest, least_step);  // f leaves zero with almost no slope: go a little further
            least_step *= 2;
        }
        t += shortest;
    }
    if (t < end) throw PhaseError("the end of a phase was not found");
    return {end, -1};
}

/// The first zero of a single function in [t, end], as first_of_zeros(); `end` if it has none.
template <class Function>
double first_zero(Function const& f, double t, double end) {
    return first_of_zeros<1>([&](double at) { return std::array{f(at)}; }, t, end).t;
}

}  // namespace vibrotrough::theory::detail
