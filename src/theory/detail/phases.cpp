#include "theory/detail/phases.hpp"

#include <algorithm>

namespace vibrotrough::theory::detail {

SlideEnd SlideMotion::end(Instant const& at, bool stopped) const {
    Decayed const d = decayed(at.t);
    return {at, stopped, stopped ? 0 : std::max(speed(at, d), 0.0), moved(at, d), d.decay, d.once};
}

SlideEnd SlideMotion::stop_between(double low, double high, double guess) const {
    Instant here{};
    auto const derivatives = [&](double t) {
        here = Instant::at(t);
        double const w = speed(here, decayed(t)), rate = forces_.drive(here) - drag_ * w;
        return Derivatives{w, rate, forces_.drive.rate(here) - drag_ * rate};
    };
    return end(instant_at(falling_zero(derivatives, low, high, guess), here), true);
}

// Between the zeros of the drive, w exp(kappa t) is monotone.
SlideEnd ContactLaw::slide(Sliding const& s, double w0, Instant const& from, Instant const& limit,
                           double hint) const {
    SlideMotion const motion(s, forces_.drag(), w0, from);
    auto const speed = [&](Instant const& at) { return motion.speed(at, motion.decayed(at.t)); };
    auto section = s.accelerates.at(from.t);
    Instant low = from;
    double w_low = w0;
    while (true) {
        if (section.positive) {
            if (!(section.end.t < limit.t)) break;
            low = section.end;
            w_low = unknown;
            s.accelerates.advance(section);
        }
        bool const whole = section.end.t < limit.t;
        Instant const& high = whole ? section.end : limit;
        double const w_high = speed(high);
        if (w_high <= 0) {
            double guess = hint > 0 ? from.t + hint : 0;
            if (!(guess > low.t && guess < high.t)) {
                if (w_low == unknown) w_low = speed(low);
                guess = low.t + (high.t - low.t) * std::acos((w_low + w_high) / (w_high - w_low)) / pi;
            }
            return motion.stop_between(low.t, high.t, guess);
        }
        if (!whole) break;
        s.accelerates.advance(section);
    }
    return motion.end(limit, false);
}

ContactLaw::Start ContactLaw::start_after(Instant const& at) const {
    Start first{{HUGE_VAL, 0, 1}, 1};
    for (double const sign : {+1.0, -1.0}) {
        Crossings const& starts = forces_.slide(sign).starts();
        auto const section = starts.at(at.t);
        if (section.positive) return {at, sign};
        if (section.end.t < first.at.t) first = {section.end, sign};
    }
    return first;
}

double ContactLaw::slope_past(Sliding const& slide, Instant const& at) const {
    double const slowing = slide.drive(at), reversed = forces_.slide(-slide.sign).drive(at);
    return slowing < 0 ? std::min(-reversed / slowing, 1.0) : 0;
}

Leap leap(Forces const& forces, Instant const& from, Instant const& to, Decayed const& d) {
    double const before = forces.vx()(from);
    return {d.decay, before * d.decay - forces.gravity() * d.once - forces.vx()(to), d.once,
            before * d.once - forces.gravity() * d.twice - (forces.x()(to) - forces.x()(from)), 0};
}

Leap leap(Forces const& forces, Hop const& hop) {
    Leap flight = leap(forces, hop.start, hop.end, hop.decayed);
    flight.impulse = forces.landing_tangent() * (hop.approach + hop.rebound);
    return flight;
}

}  // namespace vibrotrough::theory::detail
