#pragma once

#include "theory/detail/common/instant.hpp"
#include "theory/errors.hpp"
#include "theory/point_mass.hpp"

#include <algorithm>
#include <cmath>

// The motion along the trough while the mass is in contact with it. Internal to this room.
// Lengths along the trough in r cos(beta), time in 1/omega, relative velocity v = x' - cos t.
namespace vibrotrough::theory::detail {

/// sin(b) - sin(a) - (b - a) cos(a).
inline double sine_excess(Instant a, Instant b) {
    return b.sine - a.sine - (b.t - a.t) * a.cosine;
}

/// A slide in one direction (Eq. 6 relative to the trough): its speed w = |v| obeys w' = b sin t - c. Where b
/// sin t > c it can start from rest and accelerates.
class Slide {
  public:
    Slide() = default;
    Slide(double sign, double b, double c);

    double sign() const { return sign_; }
    bool can_start() const { return length_ > 0; }
    /// The phase at which it can start (Eqs. 7, 8), in [0, 2 pi).
    Instant begin() const { return {begin_, begin_sine_, begin_cosine_}; }
    double acceleration(double sine) const { return b_ * sine - c_; }
    double speed(double w0, Instant from, double t, double cosine) const {
        return w0 - c_ * (t - from.t) - b_ * (cosine - from.cosine);
    }
    /// Eq. 10, with an initial speed.
    double distance(double w0, Instant from, Instant to) const {
        double const h = to.t - from.t;
        return w0 * h - c_ * h * h / 2 - b_ * sine_excess(from, to);
    }
    /// Time from t until a slide can start; infinite if it never can.
    double wait(double t) const {
        if (!can_start()) return HUGE_VAL;
        double const p = position(t);
        return p < length_ ? 0 : two_pi - p;
    }
    /// The time when the speed reaches zero (Eq. 11), at the latest `limit`; `stopped` is set to whether it
    /// did.
    /// @param begins  whether the slide starts at begin(): rounding could put the instant just before it
    /// @param hint    a guess of the duration, or `unknown`; it changes the cost but not the result
    Instant stop(double w0, Instant from, Instant limit, bool begins, double hint, bool& stopped) const;

  private:
    double position(double t) const {
        double const x = t - begin_;
        double const p = x - two_pi * std::floor(x * (1 / two_pi));
        return two_pi - p > 1e-15 * (1 + std::abs(t)) ? p
                                                      : 0;  // rounding: just before begin() counts as begin()
    }
    Instant stop_between(double w0, Instant from, double lo, double hi, double steepest, double hint) const;

    double sign_ = 1, b_ = 0, c_ = 0;
    double begin_ = 0, length_ = 0;  // it accelerates in [begin, begin + length] modulo 2 pi
    double begin_sine_ = 0, begin_cosine_ = 1;
};

/// The forces that act on the mass along the trough.
struct Law {
    double friction_tangent;  ///< mu tan(beta)
    double gravity;           ///< tan(alpha) tan(beta) / Gamma
    Slide positive, negative;
};

Law make_law(PointMass const& input);

/// d v / d v0 after a stop. Either the mass slides back at once, so that its velocity depends on the time of
/// the stop, or it rests and no longer depends on the initial velocity.
inline double slope_past_stop(Slide const& slide, Slide const& back, double sine, double slope) {
    double const slowing = slide.acceleration(sine), reversed = back.acceleration(sine);
    return reversed > 0 && slowing < 0 ? slope * std::min(-reversed / slowing, 1.0) : 0;
}

/// Follows the contact from `at` to `end`. Calls `record(kind, from, to, displacement, slope)` for each
/// phase.
template <class Record>
Tangent follow_contact(Law const& law, Tangent s, Instant at, Instant const end, bool landed, Hints& hints,
                       Record& record) {
    for (int guard = 0; at.t < end.t; ++guard) {
        if (guard > max_contact_phases) throw PhaseError("the contact does not end");
        bool forward = s.v > 0, begins = false;
        if (s.v == 0) {
            double const wait_p = law.positive.wait(at.t), wait_n = law.negative.wait(at.t);
            double const wait = std::min(wait_p, wait_n);
            forward = wait_p <= wait_n;
            if (wait > 0) {
                bool const to_end = wait >= end.t - at.t;
                Instant next = end;
                if (!to_end) {
                    next = (forward ? law.positive : law.negative).begin();
                    next.t = at.t + wait;
                }
                record(PhaseKind::rest, at, next, 0.0, 0.0);
                s = {0, 0};
                if (to_end) return s;
                at = next;
                landed = false;
                begins = true;
            }
        }
        Slide const& slide = forward ? law.positive : law.negative;
        double const w0 = std::abs(s.v);
        bool stopped = false;
        Instant const to = slide.stop(w0, at, end, begins, hints.guess(), stopped);
        hints.learn(stopped ? to.t - at.t : unknown);
        record(slide_kind(forward, landed), at, to, slide.sign() * slide.distance(w0, at, to), s.slope);
        landed = false;
        if (!stopped) return {slide.sign() * std::max(slide.speed(w0, at, to.t, to.cosine), 0.0), s.slope};
        Slide const& back = forward ? law.negative : law.positive;
        s = {0, slope_past_stop(slide, back, to.sine, s.slope)};
        at = to;
    }
    return s;
}

}  // namespace vibrotrough::theory::detail
