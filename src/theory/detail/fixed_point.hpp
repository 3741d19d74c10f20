#pragma once

#include "theory/detail/instant.hpp"
#include "theory/errors.hpp"

#include <cmath>

// The velocity that repeats after a period. Internal to this module.
namespace vibrotrough::theory::detail {

/// Eqs. 17, 18: the landing reduces the slip velocity by mu tan(beta) times the approach velocity, at most to
/// zero.
inline Tangent landed(Tangent s, double impulse) {
    if (std::abs(s.v) <= impulse) return {0, 0};
    return {s.v - std::copysign(impulse, s.v), s.slope};
}

struct FixedPoint {
    double v;      ///< velocity at which the map was last evaluated
    double error;  ///< Newton's estimate of the fixed point minus v
};

/// The fixed point of a map v -> (f(v), f'(v)) with 0 <= f' <= 1, by Newton within a bracket.
///
/// f(v) - v never increases, so that every evaluation shows on which side the fixed point is. Where f' = 1 to
/// within rounding the velocity drifts by the same amount in every period; the step is then doubled until
/// that region is left. The fixed point must exist (|tan(alpha)| <= mu); otherwise PhaseError is thrown.
/// @param tolerance  stops when the estimated error of v is below tolerance (1 + |v|)
template <class Map>
FixedPoint fixed_point(Map const& map, double v, double tolerance) {
    constexpr double rounding = 1e-14;  // of f'
    double lo = -HUGE_VAL, hi = HUGE_VAL, stride = 1;
    for (int i = 0; i < 2000; ++i) {
        Tangent const after = map(v);
        double const drift = after.v - v, scale = 1 + std::abs(v);
        if (std::abs(drift) <= 1e-15 * scale) return {v, 0};
        (drift > 0 ? lo : hi) = v;
        bool const drifts = 1 - after.slope < rounding;
        double const step = drifts ? drift * (stride *= 2) : drift / (1 - after.slope);
        double next = v + step;
        bool const inside = next > lo && next < hi;
        if (inside && !drifts && std::abs(step) <= tolerance * scale) return {v, step};
        if (hi - lo <= 1e-15 * scale || next == v) return {v, 0};
        if (!inside) {
            bool const bracketed = std::isfinite(lo) && std::isfinite(hi);
            next = bracketed ? lo + (hi - lo) / 2 : v + drift * (stride *= 2);
        }
        v = next;
    }
    throw PhaseError("the velocity at the start of the period was not found");
}

}  // namespace vibrotrough::theory::detail
