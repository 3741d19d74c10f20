#include "theory/detail/rolling/walk.hpp"

#include <algorithm>
#include <cmath>

namespace vibrotrough::theory::detail {
namespace {

constexpr int most_phases = 2000;  // within one piece of the normal motion
enum End { of_piece, slip_stops, spin_stops, friction_forwards, friction_backwards };

int sign(double x) {
    return (x > 0) - (x < 0);
}

/// The viscous torque. A rate of its own that is that of a decay of the landing to within 1e-7 is moved by as
/// much, because the sums of both would cancel each other.
double apart_from_landing(RollingLaw const& law) {
    if (std::isinf(law.stiffness)) return law.torque;
    constexpr double apart = 1e-7;
    double torque = law.torque;
    for (double const inertia : {law.spin_inertia, 1 + law.spin_inertia})
        for (double const rate : landing_rates(law))
            if (std::abs(torque / inertia / rate - 1) < apart) torque = inertia * rate * (1 + 2 * apart);
    return torque;
}

}  // namespace

RollingWalk::RollingWalk(RollingLayer const& layer)
    : gravity_(layer.point.tan_inclination * layer.point.tan_vibration_angle / layer.point.throw_number),
      tangent_(layer.point.tan_vibration_angle),
      friction_(layer.point.friction),
      dry_(layer.law.dry_torque),
      inertia_(layer.law.spin_inertia),
      torque_(apart_from_landing(layer.law)),
      weight_(layer.point.tan_vibration_angle / layer.point.throw_number),
      no_spin_(std::isinf(layer.law.torque)) {}

/// The mean of N is the weight. From I w' = -F - c w with |F| <= mu N, |w| is at most mu weight (length / I +
/// 1 / c). The mean of F is gravity, which is below mu N, so that the slip v - w is zero at some time; from
/// there v changes by at most 2 (the trough) and the impulses of gravity and friction. Twice the sum is safe
/// against rounding.
double RollingWalk::greatest_velocity(double length) const {
    double const spin = no_spin_ ? 0 : friction_ * weight_ * (length / inertia_ + 1 / torque_);
    return 2 * (spin + 2 + (std::abs(gravity_) + friction_ * weight_) * length);
}

/// Sets the velocities of a phase.
void RollingWalk::solve(RollingPhase& p, Instant const& start) const {
    bool const rolls = p.contact && p.slip == 0, turns = p.contact ? p.turn != 0 : !no_spin_;
    double const inertia = rolls ? 1 + inertia_ : inertia_, rate = turns ? torque_ / inertia : 0;
    p.basis = {p.start, {rate, p.normal.basis.rates[1], p.normal.basis.rates[2]}};
    p.n = p.contact ? p.normal.force.from(p.normal.basis.at(p.start)) : PhaseSum{};
    PhaseSum const drive{.constant = -gravity_, .sine = 1};
    if (turns) {
        double const dry = p.contact ? p.turn * dry_ : 0, driving = rolls ? 0 : p.slip * friction_;
        PhaseSum torque = PhaseSum{}.add((driving - dry) * tangent_ / inertia, p.n);
        if (rolls) torque.add(1 / inertia, drive);
        p.w = driven(rate, torque, p.spin, p.basis, start);
    }
    p.v = rolls ? p.w
                : driven(0, PhaseSum(drive).add(-p.slip * friction_ * tangent_, p.n), p.velocity, p.basis,
                         start);
}

/// The friction that keeps a layer from slipping.
PhaseSum RollingWalk::needed_friction(RollingPhase const& p) const {
    return p.w.derivative(p.basis).add(1, {.constant = gravity_, .sine = -1});
}

double RollingWalk::friction_force(RollingPhase const& p, double t) const {
    if (!p.contact) return 0;
    PhaseTime const at = p.basis.at(t);
    return p.slip != 0 ? -p.slip * friction_ * tangent_ * p.n(at) : needed_friction(p)(at);
}

/// The phase that begins in state s. @param leaving  a rolling or resting phase ended here because its
/// friction force reached its limit in this direction; else 0
RollingPhase RollingWalk::next_phase(NormalPiece const& piece, Contact const& contact, RollingState s,
                                     int leaving) const {
    double const t = contact.start.t;
    RollingPhase p{
        .start = t, .end = t, .slip = 0, .turn = 0, .contact = piece.contact, .velocity = s.v, .spin = s.w};
    p.normal = piece;
    if (!piece.contact) return p;
    p.slip = sign(s.v - s.w);
    p.turn = sign(s.w);
    bool const may_turn = !no_spin_ && friction_ > dry_;
    if (p.slip != 0) {
        if (p.turn == 0 && may_turn) p.turn = p.slip;
        return p;
    }
    return from_no_slip(p, contact, leaving);
}

RollingPhase RollingWalk::from_no_slip(RollingPhase p, Contact const& contact, int leaving) const {
    bool const may_turn = !no_spin_ && friction_ > dry_;
    double const needed = gravity_ - contact.start.sine, normal_force = contact.normal_force;
    if (p.turn == 0) {
        double const bears = std::min(friction_, no_spin_ ? friction_ : dry_) * normal_force;
        if (leaving == 0 && std::abs(needed) <= bears) return p;  // rests
        int const way = leaving != 0 ? -leaving : -sign(needed);
        if (!may_turn) {
            p.slip = way;
            return p;
        }
        p.turn = way;
        leaving = 0;
    }
    double const spin_up = (-needed - torque_ * p.spin - p.turn * dry_ * normal_force) / (1 + inertia_);
    double const force = spin_up + needed;
    if (leaving == 0 && std::abs(force) <= friction_ * normal_force) return p;  // rolls
    p.slip = leaving != 0 ? -leaving : -sign(force);
    return p;
}

double RollingWalk::end_of(RollingPhase const& p, double end, int& what) const {
    what = of_piece;
    if (!p.contact) return end;
    Margin const turning = p.turn == 0 ? Margin() : Margin(PhaseSum{}.add(p.turn, p.w));
    if (p.slip != 0) {
        Margin const slipping(PhaseSum{}.add(p.slip, p.v).add(-p.slip, p.w));
        double const to = first_end<2>({turning, slipping}, p.basis, p.start, end, what);
        what = what < 0 ? of_piece : what == 0 ? spin_stops : slip_stops;
        return to;
    }
    double const limit =
        (p.turn == 0 ? std::min(friction_, no_spin_ ? friction_ : dry_) : friction_) * tangent_;
    PhaseSum const needed = needed_friction(p);
    Margin const forwards(PhaseSum{}.add(-1, needed).add(limit, p.n));
    Margin const backwards(PhaseSum(needed).add(limit, p.n));
    double const to = first_end<3>({turning, forwards, backwards}, p.basis, p.start, end, what);
    constexpr std::array ends{spin_stops, friction_forwards, friction_backwards};
    what = what < 0 ? of_piece : ends[static_cast<std::size_t>(what)];
    return to;
}

/// The impulse of a rigid landing: Coulomb friction until the slip ends, with the dry torque in proportion.
RollingState RollingWalk::land(RollingState s, double impulse) const {
    double left = impulse * tangent_;
    bool const may_turn = !no_spin_ && friction_ > dry_;
    for (int i = 0; i < 8 && left > 0; ++i) {
        int const slip = sign(s.v - s.w);
        int turn = sign(s.w);
        if (slip == 0 && turn == 0) break;
        if (turn == 0 && may_turn) turn = slip;
        double rate_v = -slip * friction_;
        double rate_w = turn == 0 ? 0 : (slip * friction_ - turn * dry_) / inertia_;
        if (slip == 0) {
            rate_w = -turn * dry_ / (1 + inertia_);
            if (std::abs(rate_w) > friction_) {  // cannot be held without slip
                rate_v = -turn * friction_;
                rate_w = (turn * friction_ - turn * dry_) / inertia_;
            } else {
                rate_v = rate_w;
            }
        }
        double step = left;
        bool stops = false, sticks = false;
        if (s.w * rate_w < 0 && -s.w / rate_w <= step) {
            step = -s.w / rate_w;
            stops = true;
        }
        if (slip != 0 && (s.v - s.w) * (rate_v - rate_w) < 0 && -(s.v - s.w) / (rate_v - rate_w) <= step) {
            double const sooner = -(s.v - s.w) / (rate_v - rate_w);
            stops = stops && sooner == step;
            step = sooner;
            sticks = true;
        }
        s.v += rate_v * step;
        s.w = stops ? 0 : s.w + rate_w * step;
        if (sticks) s.v = s.w;
        if (slip == 0 && rate_v == rate_w) s.v = s.w;
        left -= step;
        if (step == 0 && !stops && !sticks) break;
    }
    return s;
}

/// The rates of v and w within a phase in state s. @param sine  of the time
RollingState RollingWalk::rates(RollingPhase const& p, double sine, double normal, RollingState s) const {
    double const drive = sine - gravity_, decay = no_spin_ ? 0 : torque_ * s.w;
    if (!p.contact) return {drive, -decay / inertia_};
    if (p.slip != 0) {
        double const friction = p.slip * friction_ * normal;
        return {drive - friction, p.turn == 0 ? 0 : (friction - p.turn * dry_ * normal - decay) / inertia_};
    }
    double const both = p.turn == 0 ? 0 : (drive - p.turn * dry_ * normal - decay) / (1 + inertia_);
    return {both, both};
}

/// Where a walk is: the state at a time, and what ended there.
struct RollingWalk::Progress {
    RollingState s;
    Instant at;
    int what, leaving;
};

/// From the start of a phase to its end, at a given time.
void RollingWalk::carry(RollingSensitivity& by, RollingPhase const& p) const {
    bool const rolls = p.contact && p.slip == 0;
    double fades = 0;  // to 0: no spin in contact
    if (!p.contact || p.turn != 0) {
        double const rate = torque_ / (rolls ? 1 + inertia_ : inertia_);
        fades = no_spin_ ? 0 : std::exp(-rate * (p.end - p.start));
    }
    by.w = {by.w.v * fades, by.w.w * fades};
    if (rolls) by.v = by.w;
}

/// Over the end of slip or spin, whose time depends on the state.
void RollingWalk::pass(RollingSensitivity& by, RollingPhase const& before, Progress const& now,
                       RollingPhase const& after, Contact const& contact) const {
    bool const same_piece = before.normal.start == after.normal.start;
    double const sine = now.at.sine, force = contact.normal_force;
    double const earlier_force = same_piece ? force : tangent_ * before.n(before.basis.at(now.at.t));
    RollingState const old = rates(before, sine, earlier_force, now.s),
                       then = rates(after, sine, force, now.s);
    bool const slip = now.what == slip_stops;
    RollingState const margin = slip ? RollingState{by.v.v - by.w.v, by.v.w - by.w.w} : by.w;
    double const fall = slip ? old.w - old.v : -old.w;
    if (fall == 0) return;
    RollingState const later{margin.v / fall, margin.w / fall};  // how much later it ends
    by.v = {by.v.v + (old.v - then.v) * later.v, by.v.w + (old.v - then.v) * later.w};
    by.w = {by.w.v + (old.w - then.w) * later.v, by.w.w + (old.w - then.w) * later.w};
}

/// Goes to the end of a phase, at most `end`.
void RollingWalk::step(Progress& now, RollingPhase& p, Contact const& contact, double end,
                       Record* record) const {
    solve(p, contact.start);
    now.what = of_piece;
    p.end = end_of(p, end, now.what);
    PhaseTime const to = p.basis.at(p.end);
    now.s = {p.v(to), p.w(to)};
    if (p.contact && p.turn == 0) now.s.w = 0;
    if (p.contact && p.slip == 0) now.s.v = now.s.w;
    if (now.what == spin_stops) now.s = {p.slip == 0 ? 0 : now.s.v, 0};
    if (now.what == slip_stops) now.s.v = now.s.w;
    now.leaving = now.what == friction_forwards ? 1 : now.what == friction_backwards ? -1 : 0;
    now.at = {to.t, to.sine, to.cosine};
    if (record == nullptr) return;
    record->travel += p.v.integral(p.basis, contact.start, to);
    if (p.end > p.start) record->phases.push_back(p);
}

RollingState RollingWalk::follow(RollingNormal const& normal, RollingState s, Record* record,
                                 RollingSensitivity* by) const {
    if (by != nullptr) *by = {};
    if (record != nullptr) {
        record->travel = 0;
        record->phases.clear();
    }
    RollingPhase last{};
    Progress now{s, Instant::at(normal.pieces.front().start), of_piece, 0};
    for (NormalPiece const& piece : normal.pieces) {
        if (no_spin_) now.s.w = 0;
        if (piece.impulse > 0) now.s = land(now.s, piece.impulse);
        if (by != nullptr && piece.impulse > 0) by->known = false;
        if (now.at.t != piece.start) now.at = Instant::at(piece.start);
        now.leaving = 0;
        for (int i = 0; now.at.t < piece.end; ++i) {
            if (i > most_phases) throw PhaseError("the floor grains chatter between rolling and sliding");
            Contact const contact{now.at, tangent_ * piece.force(piece.basis.at(now.at.t))};
            RollingPhase p = next_phase(piece, contact, now.s, now.leaving);
            bool const passes = by != nullptr && (now.what == spin_stops || now.what == slip_stops);
            if (passes) pass(*by, last, now, p, contact);
            step(now, p, contact, piece.end, record);
            if (by == nullptr) continue;
            carry(*by, p);
            last = p;
        }
    }
    return now.s;
}

}  // namespace vibrotrough::theory::detail
