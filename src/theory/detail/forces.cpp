#include "theory/detail/forces.hpp"

#include <algorithm>

namespace vibrotrough::theory::detail {
namespace {

bool same(std::vector<Harmonic> const& a, std::vector<Harmonic> const& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](Harmonic const& p, Harmonic const& q) {
        return p.order == q.order && p.amplitude == q.amplitude && p.phase == q.phase;
    });
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

/// The position of the trough: an acceleration -amplitude sin(order t + phase) belongs to amplitude / order^2
/// sin(...).
void Forces::set_trough(Conveyor const& c) {
    std::vector<int> orders;
    for (auto const* harmonics : {&c.along, &c.normal})
        for (Harmonic const& h : *harmonics)
            if (h.order > 1) orders.push_back(h.order);
    std::sort(orders.begin(), orders.end());
    orders.erase(std::unique(orders.begin(), orders.end()), orders.end());
    auto const set = [&](Wave& wave, double ratio, double phase, std::vector<Harmonic> const& harmonics) {
        wave.sine = phase == 0 ? ratio : ratio * std::cos(phase);
        wave.cosine = phase == 0 ? 0 : ratio * std::sin(phase);
        wave.overtones.clear();
        for (int const order : orders) wave.overtones.push_back({order, 0, 0});
        for (Harmonic const& h : harmonics) {
            double const size = h.amplitude / h.order / h.order;
            auto const place = std::lower_bound(orders.begin(), orders.end(), h.order) - orders.begin();
            Overtone* const o = h.order > 1 ? &wave.overtones[static_cast<std::size_t>(place)] : nullptr;
            (o != nullptr ? o->sine : wave.sine) += size * std::cos(h.phase);
            (o != nullptr ? o->cosine : wave.cosine) += size * std::sin(h.phase);
        }
    };
    set(x_, c.along_ratio, c.along_phase, c.along);
    set(y_, 1, 0, c.normal);
    vx_.set_derivative(0, 1, x_);
    vy_.set_derivative(0, 1, y_);
}

void Forces::set(Conveyor const& c) {
    double const gravity = 1 / c.point.throw_number;
    double const weight = gravity;  // and a constant force normal to the trough
    same_normal_ = known_ && weight == weight_ && c.air_drag == last_.air_drag &&
                   c.restitution == last_.restitution && c.slowest_rebound == last_.slowest_rebound &&
                   same(c.normal, last_.normal);
    bool const same_drive = known_ && c.air_drag == last_.air_drag && c.along_ratio == last_.along_ratio &&
                            c.along_phase == last_.along_phase && same(c.along, last_.along) &&
                            same(c.normal, last_.normal);
    known_ = false;  // stays so if the next lines throw
    last_ = c;
    double const tan_beta = c.point.tan_vibration_angle;
    EffectiveFriction const friction = effective_friction(c);
    weight_ = weight;
    gravity_ = c.point.tan_inclination * tan_beta * gravity;
    kinetic_ = friction.kinetic_friction * tan_beta;
    landing_ = friction.landing_friction * tan_beta;
    if (!same_drive) set_trough(c);
    if (!same_drive || !same_normal_) {
        normal_.set_derivative(1, drag(), y_);
        normal_.constant = weight_;
        presses_.find(normal_);
        needed_.set_derivative(1, drag(), x_);
    }
    needed_.constant = gravity_;
    set_slide(positive_, +1, friction.static_friction * tan_beta);
    set_slide(negative_, -1, friction.static_friction * tan_beta);
    known_ = true;
}

double Forces::steepest_held(bool lands) const {
    EffectiveFriction const friction = effective_friction(last_);
    return std::max(friction.static_friction, lands ? friction.landing_friction : 0);
}

void Forces::set_constant(double needed, double friction) {
    known_ = false;
    last_ = {};
    needed_ = {};
    needed_.constant = needed;
    normal_ = {};
    normal_.constant = friction;
    kinetic_ = 1;
    set_slide(positive_, +1, kinetic_);
    set_slide(negative_, -1, kinetic_);
}

// u' = -kappa u - gravity - sign mu tan(beta) N; with u = X' + v the speed w = sign v obeys w' = -kappa w +
// drive. A slide starts from rest where the friction that rest needs exceeds mu_s tan(beta) N.
void Forces::set_slide(Sliding& s, double sign, double rest) {
    s.sign = sign;
    s.one_friction = rest <= kinetic_;
    s.drive.set_sum(-sign, needed_, -kinetic_, normal_);
    s.response.set_response(drag(), s.drive);
    s.path.set_response(0, s.response);
    s.accelerates.find(s.drive);
    if (s.one_friction) return;
    s.unheld.set_sum(-sign, needed_, -rest, normal_);
    s.own_starts.find(s.unheld);
}

}  // namespace vibrotrough::theory::detail
