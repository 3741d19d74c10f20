#pragma once

#include "theory/detail/first_zero.hpp"

#include <array>
#include <cmath>

// What happens within one phase of a rolling layer. Internal to this room.
namespace vibrotrough::theory::detail {

/// A time within a phase, and all functions of which the motion is a sum.
struct PhaseTime {
    double t, h;  ///< h since the start
    double sine, cosine;
    std::array<double, 3> decays;  ///< exp(-rate h)
};

/// The functions that the sums of one phase have in common: the rates of its three decays.
struct PhaseBasis {
    double start;
    std::array<double, 3> rates;  ///< of the phase itself and of the two decays of the contact force

    PhaseTime at(double t) const {
        double const h = t - start;
        return {t,
                h,
                std::sin(t),
                std::cos(t),
                {std::exp(-rates[0] * h), std::exp(-rates[1] * h), std::exp(-rates[2] * h)}};
    }
};

/// constant + slope h + sine sin t + cosine cos t + decays
struct PhaseSum {
    double constant = 0, slope = 0, sine = 0, cosine = 0;
    std::array<double, 3> decays{};  ///< amplitudes at the start

    double operator()(PhaseTime const& at) const {
        return constant + slope * at.h + sine * at.sine + cosine * at.cosine + decays[0] * at.decays[0] +
               decays[1] * at.decays[1] + decays[2] * at.decays[2];
    }
    PhaseSum derivative(PhaseBasis const& basis) const {
        return {slope,
                0,
                -cosine,
                sine,
                {-basis.rates[0] * decays[0], -basis.rates[1] * decays[1], -basis.rates[2] * decays[2]}};
    }
    PhaseSum& add(double factor, PhaseSum const& other) {
        constant += factor * other.constant;
        slope += factor * other.slope;
        sine += factor * other.sine;
        cosine += factor * other.cosine;
        for (std::size_t i = 0; i < decays.size(); ++i) decays[i] += factor * other.decays[i];
        return *this;
    }
};

/// A sum that stays positive until the phase ends.
class Margin {
  public:
    /// One that has no zero.
    Margin() : sum_{.constant = 1} {}
    explicit Margin(PhaseSum const& sum)
        : sum_(sum), wave_(std::sqrt(sum.sine * sum.sine + sum.cosine * sum.cosine)) {}

    /// Of several bounds that hold, the one that allows the largest step. A decay with a
    /// positive amplitude is convex and stays above its tangent. One with a negative amplitude rises: it is
    /// bounded by its second derivative or, which is better where it is fast, from below by its value.
    Sample at(PhaseTime const& time, PhaseBasis const& basis) const {
        double rate = sum_.slope + sum_.sine * time.cosine - sum_.cosine * time.sine;
        double rising = 0, bend = 0;  // beside that of the wave
        for (std::size_t i = 0; i < sum_.decays.size(); ++i) {
            double const slope = -basis.rates[i] * sum_.decays[i] * time.decays[i];
            if (slope <= 0) {
                rate += slope;
            } else {
                rising += slope;
                bend += slope * basis.rates[i];
            }
        }
        double const value = sum_(time);
        Sample best{.value = value, .rate = rate + rising, .bend = wave_ + bend};
        double step = safe_step(best);
        if (rising > 0) {
            Sample const flat{.value = value, .rate = rate, .bend = wave_};
            double const longer = safe_step(flat);
            if (longer > step) {
                best = flat;
                step = longer;
                bend = 0;
            }
        }
        // The wave's second derivative is known here, and its third one is at most `wave_`.
        double const reach = 1.5 * step, curvature = -sum_.sine * time.sine - sum_.cosine * time.cosine;
        Sample const curved{.value = value,
                            .rate = best.rate,
                            .bend = bend + std::max(wave_ * reach / 3 - curvature, 0.0),
                            .reach = reach};
        return safe_step(curved) > step ? curved : best;
    }

  private:
    PhaseSum sum_;
    double wave_ = 0;
};

}  // namespace vibrotrough::theory::detail
