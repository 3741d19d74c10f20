#include "theory/detail/flights.hpp"

#include "theory/detail/root.hpp"
#include "theory/errors.hpp"

#include <algorithm>

namespace vibrotrough::theory::detail {
namespace {

constexpr int most_sections = 200000;        // of one flight
constexpr double long_flight = 65 * two_pi;  // rad: longer than any flight of a period
constexpr double take_off_rounding = 1e-9;   // rad, of a take-off right after a landing at a late time
constexpr double series_range = 0.01;        // rad of the highest order, for flights that a series describes
/// Sine and cosine a step later, exact to rounding for |d| <= 0.01.
Instant series_shifted(Instant const& a, double d) {
    double const q = d * d, sine = d * (1 - q / 6 * (1 - q / 20)), less = q / 2 * (1 - q / 12 * (1 - q / 30));
    return {a.t + d, a.sine + (a.cosine * sine - a.sine * less),
            a.cosine - (a.sine * sine + a.cosine * less)};
}

}  // namespace

double Ballistic::surely_above() const {
    double const highest = forces_.y().bound(), weight = forces_.weight();
    auto const is_below = [&](double h) {
        Decayed const d = Decayed::after(forces_.drag(), h);
        return level_ + speed_ * d.once - weight * d.twice > highest ? -1.0 : 1.0;
    };
    if (!(2 * speed_ > weight * long_flight)) return 0;
    // Without drag it falls back to its level at the second time, and with drag before.
    double high = 2 * speed_ / weight, low = high / 2;
    while (low > 1 && is_below(low) > 0) low /= 2;
    if (is_below(low) > 0) return 0;
    while (is_below(high) < 0) high *= 2;
    auto const close = [](double a, double b) { return b - a < 1; };
    return boost::math::tools::bisect(is_below, low, high, close).first;
}

FlightChain::Start FlightChain::from_contact(Instant const& at) const {
    auto section = forces_.presses().at(at.t);
    if (!section.positive) return {at, 0, -1};  // the trough falls away at once
    return {section.end, 0, static_cast<int>(section.next)};
}

FlightChain::Start FlightChain::from(MotionStart const& start) const {
    return start.rebound > 0 ? Start{start.at, start.rebound, -1} : from_contact(start.at);
}

Hop FlightChain::fly(Start const& start, Start& next) const {
    Hop hop = flight(start);
    double const bounce = forces_.restitution() * hop.approach;
    hop.rebound = bounce > forces_.slowest_rebound() ? bounce : 0;
    next = hop.rebound > 0 ? Start{hop.end, hop.rebound, -1} : from_contact(hop.end);
    hop.leave = next.at;
    if (!std::isfinite(next.at.t)) return hop;
    next.at.t -= two_pi * std::floor(next.at.t * (1 / two_pi));
    return hop;
}

/// A flight so short that the gap is a polynomial: no sine is needed, and no digits are lost.
bool FlightChain::short_flight(Start const& start, Hop& hop) const {
    if (!(start.rate > 0)) return false;
    Wave const& normal = forces_.normal_force();
    double const force = normal(start.at);
    double h = 2 * start.rate / force;
    double const range = series_range / normal.highest_order();
    if (!(force > 0 && h < range)) return false;
    double const k = forces_.drag();
    double const g2 = -force - k * start.rate, g3 = -normal.rate(start.at) - k * g2;
    double const g4 = -normal.bend(start.at) - k * g3;
    // The next derivatives: those of the fundamental dominate, and the rest is below rounding in this range.
    double const g5 = normal.rate(start.at) - k * g4, g6 = normal.bend(start.at) - k * g5;
    if (!normal.overtones.empty() || k > 1) {
        if (h > range / 10) return false;
    }
    for (int i = 0; i < 20; ++i) {
        double const over =
            start.rate + h * (g2 / 2 + h * (g3 / 6 + h * (g4 / 24 + h * (g5 / 120 + h * g6 / 720))));
        double const slope = g2 / 2 + h * (g3 / 3 + h * (g4 / 8 + h * (g5 / 30 + h * g6 / 144)));
        if (!(slope < 0)) return false;
        double const step = -over / slope;
        h += step;
        if (!(h > 0 && h < range)) return false;
        if (std::abs(step) <= 1e-9 * h) break;  // the next step would be its square
        if (i == 19) return false;
    }
    double const rate = start.rate + h * (g2 + h * (g3 / 2 + h * (g4 / 6 + h * (g5 / 24 + h * g6 / 120))));
    hop = {start.at, series_shifted(start.at, h), {}, std::max(-rate, 0.0), 0, Decayed::after(k, h)};
    return true;
}

/// The flight whose gap falls to zero between low and high.
Hop FlightChain::landing(Start const& start, Ballistic const& path, double low, double high) const {
    Wave const& normal = forces_.normal_force();
    Instant here{};
    auto const derivatives = [&](double t) {
        here = Instant::at(t);
        Decayed const d = path.decayed(t);
        double const rate = path.rate(here, d);
        return Derivatives{path.gap(here, d), rate, -normal(here) - forces_.drag() * rate};
    };
    double guess = start.at.t + 2 * start.rate / normal(start.at);
    if (start.rate == 0) {
        // From contact: a fit to the flights of a plain sine, which depend on this ratio only (Eqs. 12-14).
        double const q = -normal.rate(start.at) / normal.bend(start.at);
        guess = start.at.t + 4 * q / (1 + 0.21 * q + 0.035 * q * q);
    }
    // The gap falls near the end, and is not yet at its lowest.
    if (!(guess > low && guess < high)) guess = high - (high - low) / 10;
    Instant const end = instant_at(falling_zero(derivatives, low, high, guess), here);
    Decayed const d = path.decayed(end.t);
    return {start.at, end, {}, std::max(-path.rate(end, d), 0.0), 0, d};
}

/// The time of the lowest gap: its rate rises from negative to positive.
double FlightChain::lowest(Ballistic const& path, double low, double high) const {
    Wave const& normal = forces_.normal_force();
    auto const derivatives = [&](double t) {
        Instant const here = Instant::at(t);
        double const rate = path.rate(here, path.decayed(t)), bend = normal(here) + forces_.drag() * rate;
        return Derivatives{-rate, bend, normal.rate(here) - forces_.drag() * bend};
    };
    return falling_zero(derivatives, low, high, low + (high - low) / 2);
}

// Between the zeros of the normal force N, g' exp(kappa t) is monotone, so that g' has one zero at most.
Hop FlightChain::flight(Start const& start) const {
    Hop hop{};
    bool found = short_flight(start, hop);
    if (!found) {
        Ballistic const path(forces_, start.at, 0, start.rate);
        auto section = forces_.presses().at(start.at.t);
        if (start.rate == 0 && section.positive) {
            if (section.end.t - start.at.t > take_off_rounding)
                throw PhaseError("a flight starts in contact");
            forces_.presses().advance(section);
        }
        double from = start.at.t, gap = 0, rate = start.rate;
        if (forces_.presses().none()) {  // the rate only falls
            double to = from + two_pi;
            while (path.gap(Instant::at(to), path.decayed(to)) > 0) to += to - from;
            return landing(start, path, from, to);
        }
        if (double const aloft = path.surely_above(); aloft > 0) {
            from += aloft;
            Decayed const d = path.decayed(from);
            gap = path.gap(Instant::at(from), d);
            rate = path.rate(Instant::at(from), d);
            section = forces_.presses().at(from);
        }
        for (int i = 0; !found; ++i) {
            if (i > most_sections || !std::isfinite(section.end.t))
                throw PhaseError("the flight does not end");
            double to = section.end.t;
            Decayed const d = path.decayed(to);
            double const end_gap = path.gap(section.end, d), end_rate = path.rate(section.end, d);
            if (section.positive) {
                found = end_rate < 0 && end_gap <= 0;
            } else if (rate < 0) {
                found = end_gap <= 0;
                if (!found && end_rate > 0 && gap + rate * (to - from) <= 0) {
                    to = lowest(path, from, to);
                    found = path.gap(Instant::at(to), path.decayed(to)) <= 0;
                }
            }
            if (found) {
                hop = landing(start, path, from, to);
            } else {
                from = section.end.t;
                gap = end_gap;
                rate = end_rate;
                forces_.presses().advance(section);
            }
        }
    }
    return hop;
}

Sensitivity Sensitivity::after(Sensitivity const& e) const {
    return {phase_phase * e.phase_phase + phase_rate * e.rate_phase,
            phase_phase * e.phase_rate + phase_rate * e.rate_rate,
            rate_phase * e.phase_phase + rate_rate * e.rate_phase,
            rate_phase * e.phase_rate + rate_rate * e.rate_rate};
}

double Sensitivity::size() const {
    return std::max(std::abs(phase_phase) + std::abs(phase_rate), std::abs(rate_phase) + std::abs(rate_rate));
}

// A later start by d lowers the gap by (rate d) and raises its rate by (N + kappa rate) d at the start, and
// the landing is where the gap is zero again.
Sensitivity FlightChain::sensitivity(Hop const& hop, double start_rate) const {
    double const kappa = forces_.drag(), approach = std::max(hop.approach, 1e-12);
    Decayed const& d = hop.decayed;
    double const push = forces_.normal_force()(hop.start) + kappa * start_rate;
    double const slowing = forces_.normal_force()(hop.end) - kappa * hop.approach;
    double const phase_phase = (d.once * push - start_rate) / approach, phase_rate = d.once / approach;
    double const e = hop.rebound > 0 ? forces_.restitution() : 0;
    return {phase_phase, phase_rate, e * (slowing * phase_phase - d.decay * push),
            e * (slowing * phase_rate - d.decay)};
}

}  // namespace vibrotrough::theory::detail
