#include "reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace vibrotrough::theory {
namespace {

using Real = long double;
constexpr Real two_pi = 2 * std::numbers::pi_v<Real>;
constexpr int steps_per_cycle = 6000;

// Lengths in r cos(beta) and r sin(beta), time in 1/omega. The trough is at X = Y = sin t.
struct Mass {
    enum class Contact { stick, slip, flight };
    PointMass p;
    Contact contact = Contact::stick;
    Real slip = 0;          // +1 forward, -1 backward
    Real t = 0, u = 1;      // time and absolute tangential velocity at the last event
    Real t_off = 0;         // take-off
    Real displacement = 0;  // absolute, tangential, up to t

    Real weight() const { return 1 / static_cast<Real>(p.throw_number); }
    Real tan_beta() const { return p.tan_vibration_angle; }
    Real mu_tan() const { return p.friction * tan_beta(); }
    Real constant() const {  // the constant part of the acceleration
        Real const hold = contact == Contact::slip ? -slip * p.friction : 0;
        return tan_beta() * weight() * (hold - p.tan_inclination);
    }
    Real sine_part() const { return contact == Contact::slip ? slip * mu_tan() : 0; }
    Real velocity(Real s) const {
        if (contact == Contact::stick) return std::cos(s);
        return u + constant() * (s - t) - sine_part() * (std::cos(s) - std::cos(t));
    }
    Real travel(Real s) const {
        if (contact == Contact::stick) return std::sin(s) - std::sin(t);
        Real const h = s - t;
        return u * h + constant() * h * h / 2 - sine_part() * (std::sin(s) - std::sin(t) - h * std::cos(t));
    }
    Real gap(Real s) const {
        Real const h = s - t_off;
        return std::sin(t_off) + std::cos(t_off) * h - weight() * h * h / 2 - std::sin(s);
    }
    Real normal_force(Real s) const { return weight() - std::sin(s); }
    /// Positive while the phase continues at time s. The phase ends at the first zero.
    Real holds(Real s) const {
        if (contact == Contact::flight) return gap(s);
        Real const force = normal_force(s);
        if (contact == Contact::slip) return std::min(force, slip * (velocity(s) - std::cos(s)));
        // Sticking requires the acceleration -sin s of the trough, against gravity.
        Real const needed = -std::sin(s) + p.tan_inclination * tan_beta() * weight();
        return std::min(force, mu_tan() * force - std::abs(needed));
    }
    void move_to(Real s) {
        displacement += travel(s);
        u = velocity(s);
        t = s;
    }
    void begin_contact() {
        Real const relative = u - std::cos(t),
                   needed = -std::sin(t) + p.tan_inclination * tan_beta() * weight();
        if (std::abs(relative) > 0) {
            contact = Contact::slip;
            slip = relative > 0 ? 1 : -1;
        } else if (std::abs(needed) > mu_tan() * normal_force(t)) {
            contact = Contact::slip;
            slip = needed > 0 ? -1 : 1;  // friction would have to push forwards: the mass lags behind
        } else {
            contact = Contact::stick;
        }
    }
    void land() {
        Real const approach = -(std::cos(t_off) - weight() * (t - t_off) - std::cos(t));
        Real const relative = u - std::cos(t), most = mu_tan() * approach;
        u = std::abs(relative) <= most ? std::cos(t) : u - std::copysign(most, relative);
        begin_contact();
    }
    void event() {
        if (contact == Contact::flight) {
            land();
        } else if (normal_force(t) > 1e-15L) {
            if (contact == Contact::slip) u = std::cos(t);
            begin_contact();
        }
        if (contact != Contact::flight && normal_force(t) <= 1e-15L) {
            contact = Contact::flight;
            t_off = t;
        }
    }
    void advance(Real to) {
        for (int guard = 0; guard < 100 && t < to; ++guard) {
            if (holds(to) >= 0) break;
            Real lo = t, hi = to;
            for (int i = 0; i < 70; ++i) {
                Real const middle = (lo + hi) / 2;
                (holds(middle) >= 0 ? lo : hi) = middle;
            }
            move_to(hi);
            event();
        }
    }
};

}  // namespace

long double reference_efficiency(PointMass const& input, int period_cycles, int periods) {
    Mass mass{.p = input};
    Real const step = two_pi / steps_per_cycle;
    Real before = 0, speed = 0, earlier = 0;
    long count = 0;
    for (int i = 0; i < periods; ++i) {
        for (int k = 0; k < period_cycles * steps_per_cycle; ++k)
            mass.advance(static_cast<Real>(++count) * step);
        Real const now = static_cast<Real>(count) * step;
        Real const at = mass.displacement + mass.travel(now), velocity = mass.velocity(now);
        Real const mean = (at - before) / (two_pi * period_cycles);
        if (i > 2 && std::abs(velocity - speed) < 1e-14L && std::abs(mean - earlier) < 1e-14L) return mean;
        before = at;
        speed = velocity;
        earlier = mean;
    }
    return std::numeric_limits<Real>::quiet_NaN();
}

}  // namespace vibrotrough::theory
