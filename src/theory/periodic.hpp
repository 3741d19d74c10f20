#pragma once

#include "theory/contact.hpp"

#include <cmath>

// The periodic motion along the trough as a fixed point. Internal to the room.
namespace vibrotrough::theory::detail {

/// The fixed point of a map v -> (f(v), f'(v)) with 0 <= f' <= 1, by Newton within a bracket.
///
/// f(v) - v never rises, so every evaluation tells on which side the fixed point is. Where f' = 1 the motion
/// drifts by the same amount every period; the step is then doubled until it leaves that stretch.
/// Range: the fixed point exists (|tan(alpha)| <= mu). Throws PhaseError otherwise.
template <class Map>
double fixed_point(Map const& map, double v) {
    double lo = -HUGE_VAL, hi = HUGE_VAL, stride = 1;
    for (int i = 0; i < 2000; ++i) {
        Tangent const after = map(v);
        double const drift = after.v - v, scale = 1 + std::abs(v);
        if (std::abs(drift) <= 1e-15 * scale) return v;
        (drift > 0 ? lo : hi) = v;
        if (hi - lo <= 1e-15 * scale) return v;
        double next = after.slope < 1 ? v + drift / (1 - after.slope) : v + drift * (stride *= 2);
        if (!(next > lo && next < hi)) {
            bool const bracketed = std::isfinite(lo) && std::isfinite(hi);
            next = bracketed ? lo + (hi - lo) / 2 : v + drift * (stride *= 2);
        }
        if (next == v) return v;
        v = next;
    }
    throw PhaseError("the velocity at the start of the period was not found");
}

}  // namespace vibrotrough::theory::detail
