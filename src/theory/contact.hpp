#pragma once

#include "theory/errors.hpp"
#include "theory/point_mass.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

// The motion along the trough while the mass touches it, and while it flies. Internal to the room.
// Lengths along the trough in r cos(beta), time in 1/omega, relative velocity v = x' - cos t.
namespace vibrotrough::theory::detail {

inline constexpr double pi = std::numbers::pi;
inline constexpr double two_pi = 2 * pi;

/// sin(t0 + h) - sin(t0) - h cos(t0).
inline double sine_excess(double t0, double h) {
    return std::sin(t0 + h) - std::sin(t0) - h * std::cos(t0);
}

/// A slide in one direction (Eq. 6 relative to the trough): its speed w = |v| changes by w' = b sin t - c.
/// It can start from rest, and speeds up, where b sin t > c.
class Slide {
  public:
    Slide() = default;
    Slide(double sign, double b, double c) : sign_(sign), b_(b), c_(c) {
        double const size = std::abs(b);
        if (c >= size) return;  // slows down always
        double const s = std::max(c / size, -1.0);
        double const delta = std::asin(s);  // Eqs. 7, 8
        begin_ = b >= 0 ? delta : delta + pi;
        length_ = pi - 2 * delta;
    }

    double sign() const { return sign_; }
    bool can_start() const { return length_ > 0; }
    double begin() const { return begin_; }
    double acceleration(double t) const { return b_ * std::sin(t) - c_; }
    double speed(double w0, double t0, double h) const {
        return w0 - c_ * h - b_ * (std::cos(t0 + h) - std::cos(t0));
    }
    /// Eq. 10, with an initial speed.
    double distance(double w0, double t0, double h) const {
        return w0 * h - c_ * h * h / 2 - b_ * sine_excess(t0, h);
    }
    /// How long from t until a slide can start; infinite when never.
    double wait(double t) const {
        if (!can_start()) return HUGE_VAL;
        double const p = position(t);
        return p < length_ ? 0 : two_pi - p;
    }
    /// Duration until the speed is zero (Eq. 11), at most h_max: then h_max is returned.
    /// A slide that begins where it can start is told so: rounding could put it just before that.
    double duration(double w0, double t0, double h_max, bool begins) const;

  private:
    double position(double t) const {
        double p = std::fmod(t - begin_, two_pi);
        if (p < 0) p += two_pi;
        return two_pi - p > 1e-15 * (1 + std::abs(t)) ? p : 0;  // rounding: just before the begin is the begin
    }
    double stop_between(double w0, double t0, double lo, double hi) const;

    double sign_ = 1, b_ = 0, c_ = 0;
    double begin_ = 0, length_ = 0;  // where it speeds up: [begin, begin + length] modulo 2 pi
};

/// What acts on the mass along the trough.
struct Law {
    double inverse_throw;     ///< 1 / Gamma
    double friction_tangent;  ///< mu tan(beta)
    double gravity;           ///< tan(alpha) tan(beta) / Gamma
    Slide positive, negative;
    double take_off;  ///< arcsin(1 / Gamma); only for Gamma > 1
};

Law make_law(PointMass const& input);

/// A flight of the normal motion: fixed by Gamma alone, whatever happens along the trough.
struct Flight {
    double start, end;
    double approach;  ///< normal velocity against the trough at landing, in omega r sin(beta), >= 0
};

/// Tangential state with its derivative with respect to the velocity at the start of the period.
struct Tangent {
    double v;
    double slope;
};

/// Follows the contact from t to t_end; `record(kind, start, end, displacement)` is told each phase.
template <class Record>
Tangent follow_contact(Law const& law, Tangent s, double t, double t_end, bool landed, Record&& record) {
    for (int guard = 0; t < t_end; ++guard) {
        if (guard > 1000000) throw PhaseError("contact does not end");
        Slide const* slide = nullptr;
        bool begins = false;
        if (s.v > 0) slide = &law.positive;
        if (s.v < 0) slide = &law.negative;
        if (slide == nullptr) {
            double const wait_p = law.positive.wait(t), wait_n = law.negative.wait(t);
            double const wait = std::min(wait_p, wait_n);
            if (wait > 0) {
                double const end = std::min(t + wait, t_end);
                record(PhaseKind::rest, t, end, 0.0);
                landed = false;
                t = end;
                begins = true;
            }
            s = {0, wait > 0 ? 0 : s.slope};
            if (t >= t_end) break;
            slide = wait_p <= wait_n ? &law.positive : &law.negative;
        }
        double const w0 = std::abs(s.v);
        double const h = slide->duration(w0, t, t_end - t, begins);
        auto const kind =
            slide->sign() > 0
                ? (landed ? PhaseKind::positive_slide_after_landing : PhaseKind::positive_slide)
                : (landed ? PhaseKind::negative_slide_after_landing : PhaseKind::negative_slide);
        bool const stops = h < t_end - t;
        double const end = stops ? t + h : t_end;
        record(kind, t, end, slide->sign() * slide->distance(w0, t, h));
        landed = false;
        if (!stops) return {slide->sign() * std::max(slide->speed(w0, t, h), 0.0), s.slope};
        // Past the stop: either it slides back at once, and the velocity then depends on the time of the
        // stop, or it rests and forgets.
        Slide const& back = slide->sign() > 0 ? law.negative : law.positive;
        double const slowing = slide->acceleration(end), reversed = back.acceleration(end);
        s = {0, reversed > 0 && slowing < 0 ? s.slope * std::min(-reversed / slowing, 1.0) : 0};
        t = end;
    }
    return s;
}

}  // namespace vibrotrough::theory::detail
