#pragma once

#include "theory/detail/instant.hpp"
#include "theory/errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

// What happens within one phase of a rolling layer. Internal to this module.
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
    std::array<double, 3> rates{0, 1, 1};  ///< of the phase itself and of the two decays of a soft contact

    PhaseTime at(double t) const {
        Instant const now = Instant::at(t);
        double const h = t - start;
        return {t,
                h,
                now.sine,
                now.cosine,
                {std::exp(-rates[0] * h), std::exp(-rates[1] * h), std::exp(-rates[2] * h)}};
    }
};

/// constant + slope h + square h^2 + sine sin t + cosine cos t + decays
struct PhaseSum {
    double constant = 0, slope = 0, square = 0, sine = 0, cosine = 0;
    std::array<double, 3> decays{};  ///< amplitudes at the start

    double operator()(PhaseTime const& at) const {
        return constant + (slope + square * at.h) * at.h + sine * at.sine + cosine * at.cosine +
               decays[0] * at.decays[0] + decays[1] * at.decays[1] + decays[2] * at.decays[2];
    }
    /// Its integral over the phase. @param from, to  the start and the end of the phase
    double integral(PhaseBasis const& basis, Instant const& from, PhaseTime const& to) const {
        double const h = to.h;
        double x = (constant + (slope / 2 + square * h / 3) * h) * h + sine * (from.cosine - to.cosine) +
                   cosine * (to.sine - from.sine);
        for (std::size_t i = 0; i < decays.size(); ++i) {
            double const rate = basis.rates[i];
            if (decays[i] == 0) continue;
            if (rate * h > 0.01)
                x += decays[i] * (1 - to.decays[i]) / rate;
            else
                x += decays[i] * (rate == 0 ? h : -std::expm1(-rate * h) / rate);
        }
        return x;
    }
    PhaseSum derivative(PhaseBasis const& basis) const {
        return {
            slope, 2 * square,
            0,     -cosine,
            sine,  {-basis.rates[0] * decays[0], -basis.rates[1] * decays[1], -basis.rates[2] * decays[2]}};
    }
    /// The same sum without slope and square, counted from a later time.
    PhaseSum from(PhaseTime const& start) const {
        PhaseSum later = *this;
        for (std::size_t i = 0; i < decays.size(); ++i) later.decays[i] *= start.decays[i];
        return later;
    }
    PhaseSum& add(double factor, PhaseSum const& other) {
        constant += factor * other.constant;
        slope += factor * other.slope;
        square += factor * other.square;
        sine += factor * other.sine;
        cosine += factor * other.cosine;
        for (std::size_t i = 0; i < decays.size(); ++i) decays[i] += factor * other.decays[i];
        return *this;
    }
};

/// The velocity x that obeys x' = -rate x + drive and is `first` at the start. The rate is 0 or that of the
/// basis, and not the rate of one of the decays of the drive, which has no slope.
inline PhaseSum driven(double rate, PhaseSum const& drive, double first, PhaseBasis const& basis,
                       Instant const& start) {
    double const size = 1 + rate * rate;
    PhaseSum x{.sine = (rate * drive.sine + drive.cosine) / size,
               .cosine = (rate * drive.cosine - drive.sine) / size};
    (rate > 0 ? x.constant : x.slope) = rate > 0 ? drive.constant / rate : drive.constant;
    double free = first - x.constant - x.sine * start.sine - x.cosine * start.cosine;
    for (std::size_t i = 1; i < drive.decays.size(); ++i) {
        if (drive.decays[i] == 0) continue;
        x.decays[i] = drive.decays[i] / (rate - basis.rates[i]);
        free -= x.decays[i];
    }
    (rate > 0 ? x.decays[0] : x.constant) += free;
    return x;
}

/// How far a function stays positive for certain: with |f''| <= bend it does for h = (f' + sqrt(f'^2 + 2 bend
/// f)) / bend. Close to a zero these are Newton steps.
inline double safe_step(double value, double rate, double bend, double reach = HUGE_VAL) {
    double const positive = std::max(value, 0.0), root = std::sqrt(rate * rate + 2 * bend * positive);
    double const step = rate < 0 ? 2 * positive / (root - rate) : (rate + root) / bend;
    return std::min(bend == 0 && rate >= 0 ? reach : step, reach);
}

/// A sum that stays positive until the phase ends.
class Margin {
  public:
    /// One that has no zero.
    Margin() : sum_{.constant = 1} {}
    explicit Margin(PhaseSum const& sum)
        : sum_(sum),
          wave_(std::sqrt(sum.sine * sum.sine + sum.cosine * sum.cosine) + 2 * std::abs(sum.square)) {}

    /// The margin at one time, and what bounds it afterwards. A decay with a positive amplitude is convex and
    /// stays above its tangent. One with a negative amplitude rises.
    struct State {
        double value, rate;
        double falling_rate;  ///< rate without the rising decays
        double rising_bend;   ///< bound of their second derivative
        double curvature;     ///< second derivative of the wave
        double bend;          ///< bound of all second derivatives
    };
    State at(PhaseTime const& time, PhaseBasis const& basis) const {
        State s{.value = sum_(time),
                .rate = 0,
                .falling_rate =
                    sum_.slope + 2 * sum_.square * time.h + sum_.sine * time.cosine - sum_.cosine * time.sine,
                .rising_bend = 0,
                .curvature = 2 * sum_.square - sum_.sine * time.sine - sum_.cosine * time.cosine,
                .bend = wave_};
        double rising = 0;
        for (std::size_t i = 0; i < sum_.decays.size(); ++i) {
            double const slope = -basis.rates[i] * sum_.decays[i] * time.decays[i];
            double const bend = std::abs(slope) * basis.rates[i];
            s.bend += bend;
            (slope <= 0 ? s.falling_rate : rising) += slope;
            if (slope > 0) s.rising_bend += bend;
        }
        s.rate = s.falling_rate + rising;
        return s;
    }
    /// How far the sum stays positive for certain, by the bounds of the second derivatives.
    double step(State const& s) const { return safe_step(s.value, s.rate, wave_ + s.rising_bend); }
    /// The largest step that several bounds allow. Beside those of step(): rising decays are bounded by their
    /// value, which is better where they are fast; and the wave by its second derivative at the start and a
    /// bound of its third one.
    double longer_step(State const& s, double step) const {
        double rate = s.rate, bend = s.rising_bend;
        if (bend > 0) {
            double const flat = safe_step(s.value, s.falling_rate, wave_);
            if (flat > step) {
                step = flat;
                rate = s.falling_rate;
                bend = 0;
            }
        }
        double const reach = 1.5 * step;
        double const later = bend + std::max(wave_ * reach / 3 - s.curvature, 0.0);
        return std::max(step, safe_step(s.value, rate, later, reach));
    }

  private:
    PhaseSum sum_;
    double wave_ = 0;
};

/// The first time in [start, end] at which one of N margins reaches zero; `end` if none does. Steps cannot
/// skip a zero.
///
/// A margin that is zero at the start and falls ends the phase at once; one whose rate is about zero is
/// looked at a first step later, within which a velocity changes by less than 1e-13.
/// @param which  is set to the number of the margin; -1: none
template <std::size_t N>
double first_end(std::array<Margin, N> const& margins, PhaseBasis const& basis, double start, double end,
                 int& which) {
    constexpr double starts_at_zero = 1e-13, first_step = 1e-7, steep = 1e-6;
    double t = start, least_step = 1e-9;
    for (int i = 0; i < 1000000 && t < end; ++i) {
        double const least = 4e-16 * (1 + std::abs(t));
        PhaseTime const time = basis.at(t);
        std::array<Margin::State, N> states;
        std::array<double, N> steps;
        bool at_zero = false;
        for (std::size_t k = 0; k < N; ++k) {
            Margin::State const& s = states[k] = margins[k].at(time, basis);
            bool const zero = i == 0 ? s.value <= starts_at_zero : !(s.value > 0);
            which = static_cast<int>(k);
            if (zero && (i == 0 ? s.rate < -steep : s.rate <= 0)) return t;
            at_zero = at_zero || zero;
            steps[k] = margins[k].step(s);
            if (i > 0 && steps[k] < least && s.rate < 0) return t;
        }
        which = -1;
        if (at_zero && i == 0) {
            t = std::min(t + first_step, end);
            continue;
        }
        // Until the shortest step is the longest that is known.
        std::array<bool, N> longest{};
        auto const shortest = [&] {
            return static_cast<std::size_t>(std::min_element(steps.begin(), steps.end()) - steps.begin());
        };
        std::size_t k = shortest();
        while (!longest[k]) {
            steps[k] = margins[k].longer_step(states[k], steps[k]);
            longest[k] = true;
            k = shortest();
        }
        double step = steps[k];
        // Where the next step would be below rounding, the zero is there.
        if (states[k].rate < 0 && states[k].bend * step * step < least * -states[k].rate && t + step < end) {
            which = static_cast<int>(k);
            return t + step;
        }
        if (step < least || at_zero) {
            step = std::max(step, least_step);
            least_step *= 2;
        }
        t += step;
    }
    which = -1;
    if (t < end) throw PhaseError("the end of a phase was not found");
    return end;
}

}  // namespace vibrotrough::theory::detail
