#include "theory/detail/conveyor/slip_map.hpp"

#include <algorithm>

namespace vibrotrough::theory::detail {
/// The speed of a slide: w' = -kappa w + drive.
struct ContactLaw::Speed {
    Sliding const& slide;
    double drag, start, free, first_path;

    Speed(Sliding const& s, double kappa, double w0, Instant const& from)
        : slide(s), drag(kappa), start(from.t), free(w0 - s.response(from)), first_path(s.path(from)) {}

    double operator()(Instant const& at, Decayed const& d) const {
        return slide.response(at) + free * d.decay + slide.drive.constant * d.once;
    }
    double operator()(Instant const& at) const { return (*this)(at, decayed(at.t)); }
    Decayed decayed(double t) const { return Decayed::after(drag, t - start); }
    SlideEnd end(Instant const& at, Decayed const& d, bool stopped) const {
        double const moved = slide.path(at) - first_path + free * d.once + slide.drive.constant * d.twice;
        return {at, stopped, stopped ? 0 : std::max((*this)(at, d), 0.0), moved, d.decay, d.once};
    }
    /// The end of a slide whose speed falls to zero between low and high.
    SlideEnd stop_between(double low, double high, double guess) const {
        Instant here{};
        auto const derivatives = [&](double t) {
            here = Instant::at(t);
            double const w = (*this)(here), rate = slide.drive(here) - drag * w;
            return Derivatives{w, rate, slide.drive.rate(here) - drag * rate};
        };
        Instant const stop = instant_at(falling_zero(derivatives, low, high, guess), here);
        return end(stop, decayed(stop.t), true);
    }
};

// Between the zeros of the drive, w exp(kappa t) is monotone.
SlideEnd ContactLaw::slide(Sliding const& s, double w0, Instant const& from, Instant const& limit,
                           double hint) const {
    Speed const speed(s, waves_.drag(), w0, from);
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
            return speed.stop_between(low.t, high.t, guess);
        }
        if (!whole) break;
        s.accelerates.advance(section);
    }
    return speed.end(limit, speed.decayed(limit.t), false);
}

ContactLaw::Start ContactLaw::start_after(Instant const& at) const {
    Start first{{HUGE_VAL, 0, 1}, 1};
    for (double const sign : {+1.0, -1.0}) {
        Crossings const& starts = waves_.slide(sign).starts();
        auto const section = starts.at(at.t);
        if (section.positive) return {at, sign};
        if (section.end.t < first.at.t) first = {section.end, sign};
    }
    return first;
}

double ContactLaw::slope_past(Sliding const& slide, Instant const& at) const {
    double const slowing = slide.drive(at), reversed = waves_.slide(-slide.sign).drive(at);
    return slowing < 0 ? std::min(-reversed / slowing, 1.0) : 0;
}

Leap leap(ConveyorWaves const& waves, Hop const& hop) {
    Decayed const& d = hop.decayed;
    double const before = waves.vx()(hop.start);
    return {d.decay, before * d.decay - waves.gravity() * d.once - waves.vx()(hop.end), d.once,
            before * d.once - waves.gravity() * d.twice - (waves.x()(hop.end) - waves.x()(hop.start)),
            waves.landing_tangent() * (hop.approach + hop.rebound)};
}

}  // namespace vibrotrough::theory::detail
