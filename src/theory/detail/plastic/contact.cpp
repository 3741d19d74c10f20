#include "theory/detail/plastic/contact.hpp"

#include <algorithm>

namespace vibrotrough::theory::detail {
Slide::Slide(double sign, double b, double c) : sign_(sign), b_(b), c_(c) {
    double const size = std::abs(b);
    if (!(c < size)) return;  // always decelerates
    double const s = std::max(c / size, -1.0);
    double const delta = std::asin(s);
    double const flip = b < 0 ? -1 : 1;
    begin_ = b < 0 ? delta + pi : (delta < 0 ? delta + two_pi : delta);
    length_ = pi - 2 * delta;
    begin_sine_ = flip * s;
    begin_cosine_ = flip * std::sqrt((1 - s) * (1 + s));
}

Law make_law(PointMass const& input) {
    double const friction_tangent = input.friction * input.tan_vibration_angle;
    double const weight = input.tan_vibration_angle / input.throw_number;
    return {.friction_tangent = friction_tangent,
            .gravity = input.tan_inclination * weight,
            .positive = Slide(+1, 1 + friction_tangent, (input.friction + input.tan_inclination) * weight),
            .negative = Slide(-1, friction_tangent - 1, (input.friction - input.tan_inclination) * weight)};
}

// The speed decreases monotonically over [lo, hi] from a positive to a zero or negative value. It decreases
// fastest at `steepest`, from where Newton's method approaches the zero from one side.
Instant Slide::stop_between(double w0, Instant from, double lo, double hi, double steepest,
                            double hint) const {
    double h = hint;
    if (!(h > lo && h < hi)) {
        double const middle = std::min(std::max(steepest, lo), hi);
        if (middle == steepest) {
            double const fall = std::abs(b_) + c_;  // there sin t = -1 (+1 for b < 0) and cos t = 0
            double const x = (w0 - c_ * steepest + b_ * from.cosine) / fall;
            h = steepest + x * (1 + std::abs(b_) / (6 * fall) * x * x);
        } else {
            h = middle;
        }
        if (!(h >= lo && h <= hi)) h = lo + (hi - lo) / 2;
    }
    for (int i = 0; i < 200; ++i) {
        Instant const here = Instant::at(from.t + h);
        double const w = speed(w0, from, from.t + h, here.cosine);
        double const slope = acceleration(here.sine);
        (w > 0 ? lo : hi) = h;
        double const newton = -w / slope, bend = b_ * here.cosine / slope;
        double const step = newton / (1 + newton * bend / 2);  // Halley
        double next = h + step;
        // Where the speed is largest, Halley's step is short and leads nowhere.
        bool const inside = slope < 0 && std::abs(newton * bend) < 1 && next >= lo && next <= hi;
        if (inside && std::abs(step) * std::max(1.0, std::abs(bend)) < root_step) return shifted(here, step);
        // Near a tangency rounding keeps the steps from shrinking: then bisect.
        if (!inside || i > 20) next = lo + (hi - lo) / 2;
        if (hi - lo <= 4e-16 * (1 + std::abs(from.t + h)) || next == h) return here;
        h = next;
    }
    throw PhaseError("the end of a slide was not found");
}

Instant Slide::stop(double w0, Instant from, Instant limit, bool begins, double hint, bool& stopped) const {
    double const h_max = limit.t - from.t;
    stopped = true;
    double p = begins ? 0 : position(from.t);
    if (!begins && p >= length_ && acceleration(from.sine) > 0) p = p > (two_pi + length_) / 2 ? 0 : length_;
    double lo = p < length_ ? length_ - p : 0;
    for (double hi = two_pi - p; lo < h_max; hi += two_pi) {
        bool const whole = hi < h_max;
        double const end = whole ? hi : h_max;
        if (speed(w0, from, from.t + end, whole ? begin_cosine_ : limit.cosine) <= 0) {
            return stop_between(w0, from, lo, end, hi - (two_pi - length_) / 2, hint);
        }
        lo = hi + length_;
    }
    stopped = false;
    return limit;
}

}  // namespace vibrotrough::theory::detail
