#pragma once

#include "theory/detail/fixed_point.hpp"
#include "theory/detail/normal_orbit.hpp"
#include "theory/detail/root.hpp"

#include <vector>

// The motion of a conveyor's mass along the trough over the flights and contacts of its normal motion.
// Internal to this module.
namespace vibrotrough::theory::detail {

/// A flight and its landing as they act on the motion along the trough: all that does not depend on the slip
/// velocity.
struct Leap {
    double decay, push;   ///< the slip velocity v becomes v decay + push before the landing
    double reach, drift;  ///< the mass moves by v reach + drift
    double impulse;       ///< by which the landing can reduce the slip
};

/// The leap of a flight from one time to another, without its landing (Eq. 16).
Leap leap(Forces const& forces, Instant const& from, Instant const& to, Decayed const& decayed);
/// The leap of a whole flight.
Leap leap(Forces const& forces, Hop const& hop);

/// The end of a slide.
struct SlideEnd {
    Instant at;
    bool stopped;
    double speed;         ///< 0 when stopped
    double moved;         ///< distance
    double decay, reach;  ///< derivatives of the speed and of the distance with respect to the speed before
};

/// A slide in one direction (Eqs. 6, 10, 11): w' = -kappa w + drive.
class SlideMotion {
  public:
    /// @param w0  speed at the start
    SlideMotion(Sliding const& forces, double kappa, double w0, Instant const& from)
        : forces_(forces),
          drag_(kappa),
          start_(from.t),
          free_(w0 - forces.response(from)),
          first_path_(forces.path(from)) {}

    Decayed decayed(double t) const { return Decayed::after(drag_, t - start_); }
    double speed(Instant const& at, Decayed const& d) const {
        return forces_.response(at) + free_ * d.decay + forces_.drive.constant * d.once;
    }
    double moved(Instant const& at, Decayed const& d) const {
        return forces_.path(at) - first_path_ + free_ * d.once + forces_.drive.constant * d.twice;
    }
    SlideEnd end(Instant const& at, bool stopped) const;
    /// Where the speed, which falls between low and high, is zero.
    SlideEnd stop_between(double low, double high, double guess) const;

  private:
    Sliding const& forces_;
    double drag_, start_, free_, first_path_;
};

/// The slides and rests of one conveyor in contact.
class ContactLaw {
  public:
    explicit ContactLaw(Forces const& forces) : forces_(forces) {}

    /// The slide with speed w0 from `from`, at most to `limit`.
    /// @param hint  a guess of its duration, or `unknown`; it changes the cost but not the result
    SlideEnd slide(Sliding const& slide, double w0, Instant const& from, Instant const& limit,
                   double hint) const;

    /// Where a mass at rest starts to slide, and in which direction; at `t` itself when it does so at once.
    struct Start {
        Instant at;
        double sign;
    };
    Start start_after(Instant const& at) const;
    /// The derivative of the velocity past a stop with respect to that before: 0 when the mass rests.
    double slope_past(Sliding const& slide, Instant const& at) const;
    bool slides_back(Sliding const& slide, double t) const {
        return forces_.slide(-slide.sign).starts().at(t).positive;
    }
    /// The velocity at a take-off from the slide or rest that came last: a rule of Table 1 of the paper,
    /// which is not physical, gives a mass that slides back after its landing the velocity of the trough.
    Tangent taking_off(Tangent const& s, PhaseKind last) const {
        bool const by_rule = forces_.starts_by_rule() && last == PhaseKind::negative_slide_after_landing;
        return by_rule ? Tangent{0, 0} : s;
    }
    Forces const& forces() const { return forces_; }

  private:
    Forces const& forces_;
};

/// Follows a contact from `at` to `end`. Calls `record(kind, from, to, v, displacement, derivative)` for each
/// phase, with the slip velocity at its start and the derivative of the displacement with respect to the
/// velocity at the start of the period.
template <class Record>
Tangent follow_contact(ContactLaw const& law, Tangent s, Instant at, Instant const& end, bool landed,
                       Hints& hints, Record& record) {
    double sliding = 0;  // the direction in which a slide from rest starts
    for (int guard = 0; at.t < end.t; ++guard) {
        if (guard > max_contact_phases) throw PhaseError("the contact does not end");
        if (s.v == 0 && sliding == 0) {
            ContactLaw::Start const start = law.start_after(at);
            if (start.at.t > at.t) {
                bool const to_end = start.at.t >= end.t;
                Instant const& to = to_end ? end : start.at;
                record(PhaseKind::rest, at.t, to.t, 0.0, 0.0, 0.0);
                s = {0, 0};
                if (to_end) return s;
                at = to;
                landed = false;
            }
            sliding = start.sign;
        }
        Sliding const& slide = law.forces().slide(sliding != 0 ? sliding : s.v);
        double const speed = std::abs(s.v);
        SlideEnd const to = law.slide(slide, speed, at, end, hints.guess(speed));
        if (to.stopped)
            hints.learn(to.at.t - at.t, speed, -to.decay / slide.drive(to.at));
        else
            hints.learn(unknown, 0, 0);
        record(slide_kind(slide.sign > 0, landed), at.t, to.at.t, s.v, slide.sign * to.moved,
               s.slope * to.reach);
        landed = false;
        at = to.at;
        sliding = 0;
        s = {slide.sign * to.speed, s.slope * to.decay};
        if (!to.stopped) return s;
        bool const back = law.slides_back(slide, at.t);
        s = {0, back ? s.slope * law.slope_past(slide, at) : 0};
        sliding = back ? -slide.sign : 0;
    }
    return s;
}

/// Follows a flight, its landing and the contact after it.
template <class Record>
Tangent follow_hop(ContactLaw const& law, Hop const& hop, Leap const& leap, Tangent s, Hints& hints,
                   Record& record) {
    record(PhaseKind::flight, hop.start.t, hop.end.t, s.v, s.v * leap.reach + leap.drift,
           s.slope * leap.reach);
    s = landed({s.v * leap.decay + leap.push, s.slope * leap.decay}, leap.impulse);
    auto last = PhaseKind::flight;
    auto const note = [&](PhaseKind kind, double from, double to, double v, double moved, double derivative) {
        last = kind;
        record(kind, from, to, v, moved, derivative);
    };
    s = follow_contact(law, s, hop.end, hop.leave, true, hints, note);
    return law.taking_off(s, last);
}

}  // namespace vibrotrough::theory::detail
