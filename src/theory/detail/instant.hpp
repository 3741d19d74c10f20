#pragma once

#include "theory/point_mass.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

// What the solvers of all models share: times, velocities and phases. Internal to this module.
namespace vibrotrough::theory::detail {

inline constexpr double pi = std::numbers::pi;
inline constexpr double two_pi = 2 * pi;
inline constexpr double unknown = -1;  ///< stands for a missing hint

/// A time together with its sine and cosine, which are the most expensive part of all calculations with it.
struct Instant {
    double t, sine, cosine;
    static Instant at(double t) { return {t, std::sin(t), std::cos(t)}; }
};

/// The tangential velocity and its derivative with respect to the velocity at the start of the period.
struct Tangent {
    double v;
    double slope;
};

/// The slides of an earlier, similar evaluation, in order: guesses for the present one.
class Hints {
  public:
    void restart() { next_ = 0; }
    /// The duration of the next slide if it starts with this speed; `unknown` when there is no guess.
    double guess(double speed) const {
        if (next_ >= slides_.size() || slides_[next_].duration < 0) return unknown;
        Slide const& s = slides_[next_];
        return s.duration + (speed - s.speed) * s.longer;
    }
    /// @param longer  by how much a slide lasts longer for each unit of its speed
    void learn(double duration, double speed, double longer) {
        if (next_ < slides_.size()) slides_[next_] = {duration, speed, longer};
        ++next_;
    }

  private:
    struct Slide {
        double duration = unknown, speed = 0, longer = 0;
    };
    std::array<Slide, 8> slides_{};
    std::size_t next_ = 0;
};

inline constexpr int max_contact_phases = 1000000;

inline PhaseKind slide_kind(bool positive, bool landed) {
    if (positive) return landed ? PhaseKind::positive_slide_after_landing : PhaseKind::positive_slide;
    return landed ? PhaseKind::negative_slide_after_landing : PhaseKind::negative_slide;
}

inline constexpr double shortest_phase = 1e-12;  ///< rad; shorter phases are rounding errors, not motion

}  // namespace vibrotrough::theory::detail
