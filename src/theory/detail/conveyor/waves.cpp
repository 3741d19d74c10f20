#include "theory/detail/conveyor/waves.hpp"

#include <algorithm>

namespace vibrotrough::theory::detail {
namespace {

/// Sets the coefficients of the part with number i, of which 0 is the fundamental.
void put(Wave& wave, std::size_t i, int order, double sine, double cosine) {
    if (i == 0) {
        wave.sine = sine;
        wave.cosine = cosine;
    } else {
        wave.overtones[i - 1] = {order, sine, cosine};
    }
}

bool same(std::vector<Harmonic> const& a, std::vector<Harmonic> const& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](Harmonic const& p, Harmonic const& q) {
        return p.order == q.order && p.amplitude == q.amplitude && p.phase == q.phase;
    });
}

bool same_normal_motion(Conveyor const& a, Conveyor const& b) {
    return a.point.throw_number == b.point.throw_number && a.air_drag == b.air_drag &&
           a.restitution == b.restitution && a.slowest_rebound == b.slowest_rebound &&
           same(a.normal, b.normal);
}

}  // namespace

Decayed Decayed::with_drag(double kappa, double h) {
    double const x = kappa * h;
    if (x < 0.02) {  // the differences below would lose digits
        double const first = 1 - x / 2 * (1 - x / 3 * (1 - x / 4 * (1 - x / 5 * (1 - x / 6))));
        double const second = 1 - x / 3 * (1 - x / 4 * (1 - x / 5 * (1 - x / 6 * (1 - x / 7))));
        return {1 - x * first, h * first, h * h / 2 * second};
    }
    double const lost = -std::expm1(-x), once = lost / kappa;
    return {1 - lost, once, (h - once) / kappa};
}

ConveyorWaves::Part& ConveyorWaves::part(int order) {
    for (Part& p : parts_) {
        if (p.order == order) return p;
    }
    return parts_.emplace_back(Part{order, 0, 0, 0, 0});
}

/// The position of the trough: an acceleration -amplitude sin(order t + phase) belongs to amplitude / order^2
/// sin(...).
void ConveyorWaves::collect(Conveyor const& c) {
    parts_.clear();
    parts_.push_back({1, c.along_ratio, 0, 1, 0});
    if (c.along_phase != 0) {
        parts_[0].x_sine = c.along_ratio * std::cos(c.along_phase);
        parts_[0].x_cosine = c.along_ratio * std::sin(c.along_phase);
    }
    for (Harmonic const& h : c.along) {
        double const size = h.amplitude / h.order / h.order;
        Part& p = part(h.order);
        p.x_sine += size * std::cos(h.phase);
        p.x_cosine += size * std::sin(h.phase);
    }
    for (Harmonic const& h : c.normal) {
        double const size = h.amplitude / h.order / h.order;
        Part& p = part(h.order);
        p.y_sine += size * std::cos(h.phase);
        p.y_cosine += size * std::sin(h.phase);
    }
    std::sort(parts_.begin(), parts_.end(), [](Part const& p, Part const& q) { return p.order < q.order; });
}

void ConveyorWaves::set(Conveyor const& c) {
    same_normal_ = known_ && same_normal_motion(c, last_);
    bool const same_drive = known_ && c.air_drag == last_.air_drag && c.along_ratio == last_.along_ratio &&
                            c.along_phase == last_.along_phase && same(c.along, last_.along) &&
                            same(c.normal, last_.normal);
    known_ = false;
    drag_ = c.air_drag;
    weight_ = 1 / c.point.throw_number;
    gravity_ = c.point.tan_inclination * c.point.tan_vibration_angle * weight_;
    restitution_ = c.restitution;
    slowest_rebound_ = c.slowest_rebound;
    EffectiveFriction const friction = effective_friction(c);
    double const tan_beta = c.point.tan_vibration_angle;
    landing_ = friction.landing_friction * tan_beta;
    if (!same_drive) {
        collect(c);
        for (Wave* const wave :
             {&x_, &vx_, &y_, &vy_, &normal_, &needed_, &hold_, &positive_.drive, &positive_.response,
              &positive_.path, &negative_.drive, &negative_.response, &negative_.path})
            wave->overtones.resize(parts_.size() - 1);
    }
    if (!same_drive || !same_normal_) set_normal();
    kinetic_ = friction.kinetic_friction * tan_beta;
    set_slide(positive_, +1, friction.static_friction * tan_beta);
    set_slide(negative_, -1, friction.static_friction * tan_beta);
    last_ = c;
    known_ = true;
}

void ConveyorWaves::set_normal() {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        Part const& p = parts_[i];
        double const k = p.order, square = k * k;
        put(x_, i, p.order, p.x_sine, p.x_cosine);
        put(vx_, i, p.order, -k * p.x_cosine, k * p.x_sine);
        put(y_, i, p.order, p.y_sine, p.y_cosine);
        put(vy_, i, p.order, -k * p.y_cosine, k * p.y_sine);
        put(normal_, i, p.order, -square * p.y_sine - drag_ * k * p.y_cosine,
            -square * p.y_cosine + drag_ * k * p.y_sine);
        put(needed_, i, p.order, -square * p.x_sine - drag_ * k * p.x_cosine,
            -square * p.x_cosine + drag_ * k * p.x_sine);
    }
    normal_.constant = weight_;
    presses_.find(normal_);
}

// u' = -kappa u - gravity - sign mu tan(beta) N; with u = X' + v the speed w = sign v obeys w' = -kappa w +
// drive. A slide starts from rest where the friction that rest needs exceeds mu_s tan(beta) N.
void ConveyorWaves::set_slide(Sliding& s, double sign, double rest) {
    double const kinetic = kinetic_;
    s.sign = sign;
    s.one_friction = rest <= kinetic;
    s.drive.constant = -sign * gravity_ - kinetic * weight_;
    if (!s.one_friction) {
        hold_.overtones.resize(parts_.size() - 1);
        hold_.constant = -sign * gravity_ - rest * weight_;
    }
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        bool const first = i == 0;
        double const k = parts_[i].order;
        double const normal_sine = first ? normal_.sine : normal_.overtones[i - 1].sine;
        double const normal_cosine = first ? normal_.cosine : normal_.overtones[i - 1].cosine;
        double const needed_sine = first ? needed_.sine : needed_.overtones[i - 1].sine;
        double const needed_cosine = first ? needed_.cosine : needed_.overtones[i - 1].cosine;
        double const sine = -sign * needed_sine - kinetic * normal_sine;
        double const cosine = -sign * needed_cosine - kinetic * normal_cosine;
        double const size = drag_ * drag_ + k * k;
        double const a = (drag_ * sine + k * cosine) / size, b = (drag_ * cosine - k * sine) / size;
        put(s.drive, i, parts_[i].order, sine, cosine);
        put(s.response, i, parts_[i].order, a, b);
        put(s.path, i, parts_[i].order, b / k, -a / k);
        if (!s.one_friction) {
            put(hold_, i, parts_[i].order, -sign * needed_sine - rest * normal_sine,
                -sign * needed_cosine - rest * normal_cosine);
        }
    }
    s.accelerates.find(s.drive);
    if (!s.one_friction) s.own_starts.find(hold_);
}

}  // namespace vibrotrough::theory::detail
