#include "theory/contact.hpp"

namespace vibrotrough::theory::detail {

Law make_law(PointMass const& input) {
    double const inverse_throw = 1 / input.throw_number;
    double const friction_tangent = input.friction * input.tan_vibration_angle;
    double const weight = input.tan_vibration_angle * inverse_throw;
    return {.inverse_throw = inverse_throw,
            .friction_tangent = friction_tangent,
            .gravity = input.tan_inclination * weight,
            .positive = Slide(+1, 1 + friction_tangent, (input.friction + input.tan_inclination) * weight),
            .negative = Slide(-1, friction_tangent - 1, (input.friction - input.tan_inclination) * weight),
            .take_off = inverse_throw < 1 ? std::asin(inverse_throw) : 0};
}

// The speed falls monotonically over [lo, hi], from above zero to zero or below.
double Slide::stop_between(double w0, double t0, double lo, double hi) const {
    double h = hi - (hi - lo) / 4;
    for (int i = 0; i < 200; ++i) {
        double const w = speed(w0, t0, h);
        (w > 0 ? lo : hi) = h;
        double const slope = acceleration(t0 + h);
        double next = slope < 0 ? h - w / slope : lo;
        if (!(next > lo && next < hi)) next = lo + (hi - lo) / 2;
        if (std::abs(next - h) <= 4e-16 * (1 + std::abs(t0 + h)) || next == lo || next == hi) return next;
        h = next;
    }
    throw PhaseError("the end of a slide was not found");
}

double Slide::duration(double w0, double t0, double h_max, bool begins) const {
    if (!can_start()) {  // slows down always
        return speed(w0, t0, h_max) > 0 ? h_max : stop_between(w0, t0, 0, h_max);
    }
    double p = begins ? 0 : position(t0);
    if (!begins && acceleration(t0) > 0 && p >= length_) p = p > (two_pi + length_) / 2 ? 0 : length_;
    double lo = p < length_ ? length_ - p : 0;
    for (double hi = two_pi - p; lo < h_max; hi += two_pi) {
        double const end = std::min(hi, h_max);
        if (speed(w0, t0, end) <= 0) return stop_between(w0, t0, lo, end);
        lo = hi + length_;
    }
    return h_max;
}

}  // namespace vibrotrough::theory::detail
