#include "conveyor_walk.hpp"

#include "first_zero.hpp"
#include "theory/detail/instant.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vibrotrough::theory {
namespace {

using detail::first_zero;
using detail::Sample;
using detail::slide_kind;

constexpr double shortest_piece = 1e-12;  // rad; shorter pieces are rounding errors
constexpr double rounding = 1e-13;        // of forces
constexpr int most_events = 2000000;
constexpr double drag_reach = 1;  // rad: the distance within which the bounds on drag below hold

void keep_piece(Passage& passage, Walk::Keep keep, Piece const& piece) {
    passage.displacement += piece.displacement;
    if (keep == Walk::Keep::pieces && piece.end - piece.start > shortest_piece)
        passage.pieces.push_back(piece);
}

}  // namespace

// The mass lags behind (N slide) when a friction force above +mu_s N is needed, and runs ahead (P slide) when
// it is below -mu_s N. The speed w of a slide obeys w' = -kappa w + drive.
WalkModel::WalkModel(Conveyor const& c) : ConveyorModel(c) {
    Trigonometric const x = trough(c.along_ratio, c.along_phase, c.along), y = trough(1, 0, c.normal);
    EffectiveFriction const friction = effective_friction(c);
    double const tangent = c.point.tan_vibration_angle, rest = friction.static_friction * tangent;
    double const kinetic = friction.kinetic_friction * tangent;
    normal_ = y.differentiated(1, drag());
    needed_ = x.differentiated(1, drag());
    hold_positive_ = {rest * weight() + gravity(), normal_ * rest + needed_};
    hold_negative_ = {rest * weight() - gravity(), normal_ * rest + needed_ * -1};
    drive_positive_ = {-gravity() - kinetic * weight(), needed_ * -1 + normal_ * -kinetic};
    drive_negative_ = {gravity() - kinetic * weight(), needed_ + normal_ * -kinetic};
    landing_ = friction.landing_friction * tangent;
    vx_bound_ = x.derivative_bound(1);
    normal_bend_ = normal_.derivative_bound(2);
    hold_bend_ = rest * normal_bend_ + needed_.derivative_bound(2);
    fall_bound_ = weight() + y.derivative_bound(2);
}

double WalkModel::take_off_after(double t, double end) const {
    auto const force = [&](double s) { return Sample{normal_force(s), normal_.rate(s), normal_bend_}; };
    return first_zero(force, t, end);
}

double WalkModel::slip_after(double sign, double t, double end) const {
    Shifted const& h = sign > 0 ? hold_positive_ : hold_negative_;
    auto const held = [&](double s) { return Sample{h.constant + h.sum(s), h.sum.rate(s), hold_bend_}; };
    return first_zero(held, t, end);
}

double WalkModel::stop_after(double sign, double t, double speed, double end) const {
    Shifted const& s = sign > 0 ? drive_positive_ : drive_negative_;
    double const drive_bound = std::abs(s.constant) + s.sum.bound();
    double const drive_rate_bound = s.sum.derivative_bound(1), drive_bend = s.sum.derivative_bound(2);
    // While the driving acceleration is positive, the speed is positive, too.
    auto const drive = [&](double a) { return Sample{slide_drive(sign, a), s.sum.rate(a), drive_bend}; };
    double const from = speed == 0 || slide_drive(sign, t) >= 0 ? first_zero(drive, t, end) : t;
    if (from >= end) return end;
    DrivenVelocity const u = slide_velocity(sign, t, trough_vx(t) + sign * speed);
    auto const slip = [&](double a) {
        double const w = sign * (u(a) - trough_vx(a));
        double const most = std::abs(w) + drive_bound * drag_reach;
        return Sample{w, slide_drive(sign, a) - drag() * w,
                      drive_rate_bound + drag() * (drive_bound + drag() * most),
                      drag() > 0 ? drag_reach : HUGE_VAL};
    };
    return first_zero(slip, from, end);
}

double WalkModel::landing_after(double t, double gap, double gap_rate, double end) const {
    double from = t;
    bool const takes_off = gap == 0 && gap_rate == 0;
    if (takes_off || (gap_rate >= 0 && normal_force(t) <= 0)) {
        // While the trough falls away faster than the mass, the gap grows: (gap)'' + kappa (gap)' = -N.
        auto const lift = [&](double s) { return Sample{-normal_force(s), -normal_.rate(s), normal_bend_}; };
        from = first_zero(lift, t, end);
        if (from >= end) return end;
    }
    DrivenVelocity const w = flight_velocity_y(t, trough_vy(t) + gap_rate);
    double const level = trough_y(t) + gap;
    auto const height = [&](double s) {
        double const rate = w(s);
        double const bend = fall_bound_ + drag() * (std::abs(rate) + weight() * drag_reach);
        return Sample{level + w.travel(s) - trough_y(s), rate - trough_vy(s), bend,
                      drag() > 0 ? drag_reach : HUGE_VAL};
    };
    return first_zero(height, from, end);
}

void Walk::advance(WalkState& s, double end, Passage& passage, Keep keep) const {
    for (int i = 0; s.t < end; ++i) {
        ++passage.events;
        if (i > most_events) throw PhaseError("the motion has more phases than can be followed");
        if (s.flying) {
            fly(s, end, passage, keep);
        } else if (s.v != 0 || s.starting != 0) {
            slide(s, end, passage, keep);
        } else {
            stick(s, end, passage, keep);
        }
    }
}

void Walk::fly(WalkState& s, double end, Passage& passage, Keep keep) const {
    double const landing = model_.landing_after(s.t, s.gap, s.gap_rate, end);
    auto const u = model_.flight_velocity_x(s.t, model_.trough_vx(s.t) + s.v);
    auto const w = model_.flight_velocity_y(s.t, model_.trough_vy(s.t) + s.gap_rate);
    double const moved = u.travel(landing) - (model_.trough_x(landing) - model_.trough_x(s.t));
    keep_piece(passage, keep,
               {PhaseKind::flight, s.t, landing, model_.trough_vx(s.t) + s.v, s.gap, s.gap_rate, moved});
    double const gap = s.gap + w.travel(landing) - (model_.trough_y(landing) - model_.trough_y(s.t));
    s.slope *= std::exp(-model_.drag() * (landing - s.t));
    s.v = u(landing) - model_.trough_vx(landing);
    s.gap_rate = w(landing) - model_.trough_vy(landing);
    s.gap = landing < end ? 0 : std::max(gap, 0.0);
    s.t = landing;
    if (landing < end) land(s, std::max(-s.gap_rate, 0.0), passage, keep);
}

// Eqs. 17, 18 and 23: the impulse is mu (1 + e) times the approach velocity (with mu of landings), limited to
// the value that stops the slip.
void Walk::land(WalkState& s, double approach, Passage& passage, Keep keep) const {
    Conveyor const& conveyor = model_.conveyor();
    double const bounce = conveyor.restitution * approach;
    double const rebound = bounce > conveyor.slowest_rebound ? bounce : 0;
    double const before = s.v, most = model_.landing_tangent() * (approach + rebound);
    if (std::abs(s.v) <= most) {
        s.v = 0;
        s.slope = 0;
        passage.stopped = true;
    } else {
        s.v -= std::copysign(most, s.v);
    }
    if (keep == Keep::pieces) passage.impacts.push_back({s.t, approach, rebound, before, s.v});
    s.gap = 0;
    s.gap_rate = rebound;
    s.flying = rebound > 0 || model_.normal_force(s.t) < 0;
    s.landed = true;
    s.starting = 0;
}

void Walk::take_off(WalkState& s) const {
    bool const by_rule = model_.conveyor().flight_start == FlightStart::trough_velocity_rule &&
                         s.kind == PhaseKind::negative_slide_after_landing;
    if (by_rule) {
        s.v = 0;
        s.slope = 0;
    }
    s.flying = true;
    s.gap = s.gap_rate = 0;
    s.starting = 0;
}

void Walk::stick(WalkState& s, double end, Passage& passage, Keep keep) const {
    passage.stopped = true;
    for (double const sign : {+1.0, -1.0}) {
        if (model_.hold(sign, s.t) > -rounding) continue;  // friction holds
        s.starting = sign;
        s.kind = slide_kind(sign > 0, s.landed);
        s.landed = false;
        return;
    }
    double const forward = model_.slip_after(+1, s.t, end);
    double const slip = std::min(forward, model_.slip_after(-1, s.t, forward));
    double const off = model_.take_off_after(s.t, slip);
    double const to = std::min(slip, off);
    double const start = s.t;
    keep_piece(passage, keep, {PhaseKind::rest, s.t, to, model_.trough_vx(s.t), 0, 0, 0});
    if (to - start > shortest_piece) {
        s.landed = false;
        s.slope = 0;
    }
    s.t = to;
    s.kind = PhaseKind::rest;
    if (to >= end) return;
    if (off < slip) {
        take_off(s);
    } else {
        s.starting = slip < forward ? -1 : +1;
        s.kind = slide_kind(s.starting > 0, s.landed);
        s.landed = false;
    }
}

void Walk::slide(WalkState& s, double end, Passage& passage, Keep keep) const {
    double const sign = s.starting != 0 ? s.starting : (s.v > 0 ? 1 : -1);
    bool const fresh =
        s.landed || (s.kind != slide_kind(sign > 0, true) && s.kind != slide_kind(sign > 0, false));
    if (fresh) s.kind = slide_kind(sign > 0, s.landed);
    s.landed = false;
    s.starting = 0;
    double const off = model_.take_off_after(s.t, end);
    double const to = model_.stop_after(sign, s.t, std::abs(s.v), off);
    auto const u = model_.slide_velocity(sign, s.t, model_.trough_vx(s.t) + s.v);
    double const moved = u.travel(to) - (model_.trough_x(to) - model_.trough_x(s.t));
    keep_piece(passage, keep, {s.kind, s.t, to, model_.trough_vx(s.t) + s.v, 0, 0, moved});
    s.slope *= std::exp(-model_.drag() * (to - s.t));
    if (to < off) {  // it stops, and either slides back at once or sticks
        passage.stopped = true;
        double const slowing = model_.slide_drive(sign, to), back = model_.slide_drive(-sign, to);
        bool const gives_way = model_.hold(-sign, to) < 0;
        s.slope = gives_way && slowing < 0 ? s.slope * std::min(-back / slowing, 1.0) : 0;
        s.v = 0;
        s.starting = gives_way ? -sign : 0;
        s.t = to;
        return;
    }
    s.v = sign * std::max(sign * (u(to) - model_.trough_vx(to)), 0.0);
    s.t = to;
    if (to < end) take_off(s);
}

}  // namespace vibrotrough::theory
