#include "theory/detail/conveyor_walk.hpp"

#include "theory/detail/contact.hpp"

#include <algorithm>
#include <cmath>

namespace vibrotrough::theory::detail {
namespace {

constexpr double shortest_piece = 1e-12;  // rad; shorter pieces are rounding errors
constexpr double rounding = 1e-13;        // of forces
constexpr int most_events = 2000000;

void keep_piece(Passage& passage, Walk::Keep keep, Piece const& piece) {
    passage.displacement += piece.displacement;
    if (keep == Walk::Keep::pieces && piece.end - piece.start > shortest_piece)
        passage.pieces.push_back(piece);
}

}  // namespace

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

}  // namespace vibrotrough::theory::detail
