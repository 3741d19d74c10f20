#pragma once

#include "theory/conveyor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

namespace vibrotrough::theory {

/// A second way to follow a point mass that rebounds from a sinusoidal trough, from any start and with any
/// type of number: phase by phase in closed form, and to the end of a phase in steps that cannot pass it. It
/// shares nothing with the solver. Units are those of the theory: r cos(beta) along the trough, r sin(beta)
/// normal to it, 1/omega.
template <class Real>
class BouncingMass {
  public:
    /// @param c      without drag, harmonics, ellipse or walls
    /// @param noise  by how much a rebound (as a share of it) and the time of a take-off (rad) differ at
    /// random, as on any machine: without it a calculation can repeat its own rounding errors for ever
    explicit BouncingMass(Conveyor const& c, Real noise = 0)
        : noise_(noise),
          weight_(1 / Real(c.point.throw_number)),
          gravity_(Real(c.point.tan_inclination) * c.point.tan_vibration_angle * weight_),
          sliding_(Real(c.point.friction) * c.point.tan_vibration_angle),
          holding_(std::max(Real(c.static_friction), Real(c.point.friction)) * c.point.tan_vibration_angle),
          landing_(Real(c.landing_friction.value_or(c.point.friction)) * c.point.tan_vibration_angle),
          restitution_(c.restitution),
          slowest_(c.slowest_rebound) {}

    Real t = 0;             ///< rad, of the last landing or take-off, within a cycle
    Real rate = 0;          ///< of the gap, upwards, with which the next flight starts
    Real v = 0;             ///< slip velocity
    Real displacement = 0;  ///< since the beginning

    /// Follows the next flight with its landing, or the contact up to the next take-off. A mass that never
    /// takes off is followed for one cycle.
    void step() {
        if (rate == 0 && !leaves_ && weight_ > std::sin(t)) {
            Real const end = take_off();
            while (t < end) touch(end);
            leaves_ = weight_ < 1;
            starts_ = 0;
            if (leaves_) t += noise_ * chance_(random_);
        } else {
            fly();
            leaves_ = false;
        }
        // Small times have small rounding errors.
        Real const whole = turn * std::floor(t / turn);
        t -= whole;
        past_ += whole;
    }
    /// Time since the beginning, rad.
    Real elapsed() const { return past_ + t; }
    /// Follows at least so many cycles. @return the mean slip velocity
    Real follow(Real cycles) {
        Real const begin = elapsed(), before = displacement;
        while (elapsed() - begin < turn * cycles) step();
        return (displacement - before) / (elapsed() - begin);
    }

  private:
    static constexpr Real turn = 2 * std::numbers::pi_v<Real>;

    /// When the normal force 1/Gamma - sin t is zero next.
    Real take_off() const {
        if (weight_ >= 1) return t + turn;
        Real const zero = std::asin(weight_);
        return zero + turn * (std::floor((t - zero) / turn) + 1);
    }

    // The gap is rate d - d^2 / (2 Gamma) + cos(t) d - (sin(t + d) - sin(t)), and its second derivative is at
    // least -(1 + 1/Gamma).
    void fly() {
        Real const start = t, speed = std::cos(t) + rate, level = std::sin(t), bound = 1 + weight_;
        Real d = 0;
        // Up to where the normal force would be positive again a gap without a rate only grows.
        if (rate == 0) d = fall_end() - t;
        Real gap = 0, slope = 0;
        for (int i = 0;; ++i) {
            gap = speed * d - weight_ * d * d / 2 - (std::sin(start + d) - level);
            slope = speed - weight_ * d - std::cos(start + d);
            Real const h = (slope + std::sqrt(slope * slope + 2 * bound * std::max(gap, Real(0)))) / bound;
            if (!(start + d + h > start + d) || i > 100000) break;
            d += h;
        }
        Real const approach = std::max(-slope, Real(0));
        Real const before = v - gravity_ * d - (std::cos(start + d) - std::cos(start));
        displacement += (v + std::cos(start)) * d - gravity_ * d * d / 2 - (std::sin(start + d) - level);
        Real const bounce = restitution_ * approach;
        rate = bounce > slowest_ ? bounce * (1 + noise_ * chance_(random_)) : Real(0);
        Real const most = landing_ * (approach + rate);
        v = std::abs(before) <= most ? Real(0) : before - std::copysign(most, before);
        t = start + d;
    }
    Real fall_end() const {
        Real const zero = std::numbers::pi_v<Real> - std::asin(weight_);
        return zero + turn * (std::floor((t - zero) / turn) + 1);
    }

    /// One slide or rest. The slip speed w = sign v obeys w' = a sin t - c.
    void touch(Real end) {
        Real sign = v > 0 ? 1 : -1;
        if (v == 0 && starts_ != 0) {
            sign = starts_;
        } else if (v == 0) {
            Real const needed = gravity_ - std::sin(t), most = holding_ * (weight_ - std::sin(t));
            if (std::abs(needed) <= most) return rest(end);
            sign = needed < 0 ? 1 : -1;
        }
        starts_ = 0;
        Real const a = sign + sliding_, c = sign * gravity_ + sliding_ * weight_, start = t, w = sign * v;
        Real const bound = std::abs(a), cosine = std::cos(start);
        // From rest the speed grows up to where the acceleration is zero; rounding may be just behind that.
        Real h = 0;
        if (w == 0) h = acceleration_end(a, c) - start;
        if (h > turn * (1 - Real(1e-9))) h = 0;
        while (start + h < end) {
            Real const speed = w - a * (std::cos(start + h) - cosine) - c * h;
            Real const rate_now = a * std::sin(start + h) - c;
            // w + w' s - bound s^2 / 2 is a lower limit of the speed.
            Real const s =
                (rate_now + std::sqrt(rate_now * rate_now + 2 * bound * std::max(speed, Real(0)))) / bound;
            if (!(start + h + s > start + h)) return slide(sign, a, c, h, true);
            h += s;
        }
        slide(sign, a, c, end - start, false);
    }
    void slide(Real sign, Real a, Real c, Real h, bool stops) {
        Real const w = sign * v, cosine = std::cos(t);
        displacement += sign * ((w + a * cosine) * h - a * (std::sin(t + h) - std::sin(t)) - c * h * h / 2);
        Real const speed = std::max(w - a * (std::cos(t + h) - cosine) - c * h, Real(0));
        v = stops ? Real(0) : sign * speed;
        // At the end of what could set it in motion rounding must not start it again and again.
        t += std::max(h, stops ? 4 * std::numeric_limits<Real>::epsilon() * (1 + std::abs(t)) : Real(0));
    }
    Real acceleration_end(Real a, Real c) const {
        Real const ratio = std::clamp(c / a, Real(-1), Real(1));
        Real const zero = a > 0 ? std::numbers::pi_v<Real> - std::asin(ratio) : std::asin(ratio);
        return zero + turn * (std::floor((t - zero) / turn) + 1);
    }
    /// The force that rest needs exceeds friction where (+-1 + holding) sin t > holding / Gamma +- gravity.
    void rest(Real end) {
        Real first = end;
        for (Real const sign : {Real(1), Real(-1)}) {
            Real const a = sign + holding_, c = sign * gravity_ + holding_ * weight_;
            if (!(std::abs(c) < std::abs(a))) continue;
            Real const zero = a > 0 ? std::asin(c / a) : std::numbers::pi_v<Real> - std::asin(c / a);
            Real const at = zero + turn * (std::floor((t - zero) / turn) + 1);
            if (at < first) first = at, starts_ = sign;
        }
        t = first;
    }

    Real starts_ = 0;      // the direction in which a slide from rest starts at t
    Real past_ = 0;        // whole cycles taken off t
    bool leaves_ = false;  // the trough at t
    std::mt19937_64 random_{1};
    std::uniform_real_distribution<Real> chance_{0, 1};
    Real noise_, weight_, gravity_, sliding_, holding_, landing_, restitution_, slowest_;
};

}  // namespace vibrotrough::theory
