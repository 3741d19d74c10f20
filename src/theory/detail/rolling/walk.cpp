#include "theory/detail/rolling/walk.hpp"

#include "theory/detail/common/first_zero.hpp"

#include <algorithm>
#include <cmath>

namespace vibrotrough::theory::detail {
namespace {

// A margin that begins at zero and falls ends the phase at once; one whose rate is about zero is looked at a
// first step later. What happens within that step changes a velocity by less than 1e-13.
constexpr double starts_at_zero = 1e-13, first_step = 1e-7, steep = 1e-6;
constexpr int most_phases = 2000;                            // within one piece of the normal motion
constexpr Sample no_zero{.value = 1, .rate = 0, .bend = 0};  // a margin that has no zero
enum End { of_piece, slip_stops, spin_stops, friction_forwards, friction_backwards };

int sign(double x) {
    return (x > 0) - (x < 0);
}

/// The first time in [start, end] at which a margin reaches zero, and which one it is; -1: none.
template <std::size_t N, class Margins>
double first_end(Margins const& margins, double start, double end, int& what) {
    auto const first = margins(start);
    double from = start;
    for (std::size_t k = 0; k < N; ++k) {
        if (first[k].value > starts_at_zero) continue;
        if (first[k].rate < -steep) {
            what = static_cast<int>(k);
            return start;
        }
        from = std::min(start + first_step, end);
    }
    auto const found = first_of_zeros<N>(margins, from, end);
    what = found.which;
    return found.t;
}

ContactForce sum(ContactForce force, double factor, double constant, double sine) {
    force = force.scaled(factor);
    force.constant += constant;
    force.sine += sine;
    return force;
}

}  // namespace

RollingWalk::RollingWalk(RollingLayer const& layer)
    : gravity_(layer.point.tan_inclination * layer.point.tan_vibration_angle / layer.point.throw_number),
      tangent_(layer.point.tan_vibration_angle),
      friction_(layer.point.friction),
      dry_(layer.law.dry_torque),
      inertia_(layer.law.spin_inertia),
      torque_(layer.law.torque),
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

Relaxation RollingWalk::velocity(RollingPhase const& p) const {
    return velocity(p, p.normal.force.from(p.start), Instant::at(p.start));
}

Relaxation RollingWalk::spin(RollingPhase const& p) const {
    return spin(p, p.normal.force.from(p.start), Instant::at(p.start));
}

Relaxation RollingWalk::velocity(RollingPhase const& p, ContactForce const& n, Instant const& start) const {
    if (p.slip == 0 && p.contact) return spin(p, n, start);
    double const push = p.contact ? -p.slip * friction_ * tangent_ : 0;
    return {0, sum(n, push, -gravity_, 1), p.velocity, start};
}

Relaxation RollingWalk::spin(RollingPhase const& p, ContactForce const& n, Instant const& start) const {
    if (!p.contact) {
        ContactForce none{.start = p.start};
        return {no_spin_ ? 0 : torque_ / inertia_, none, p.spin, start};
    }
    if (p.turn == 0) return {0, ContactForce{.start = p.start}, 0, start};
    if (p.slip == 0) {
        double const mass = 1 + inertia_;
        return {torque_ / mass, sum(n, -p.turn * dry_ * tangent_ / mass, -gravity_ / mass, 1 / mass), p.spin,
                start};
    }
    return {torque_ / inertia_, n.scaled((p.slip * friction_ - p.turn * dry_) * tangent_ / inertia_), p.spin,
            start};
}

RollingWalk::Forces RollingWalk::forces(RollingPhase const& p, Contact const& contact) const {
    Relaxation const w = spin(p, contact.n, contact.start);
    Relaxation const v = p.contact && p.slip == 0 ? w : velocity(p, contact.n, contact.start);
    // The first decay of the phase: v has none of its own while it slips or flies.
    bool const turns = p.contact ? p.turn != 0 : !no_spin_;
    double const own = turns ? torque_ / (p.contact && p.slip == 0 ? 1 + inertia_ : inertia_) : 0;
    return {contact.n, v,       w,
            v.sum(),   w.sum(), {p.start, {own, contact.n.decays[0].rate, contact.n.decays[1].rate}}};
}

double RollingWalk::friction_force(RollingPhase const& p, double t) const {
    if (!p.contact) return 0;
    if (p.slip != 0) return -p.slip * friction_ * tangent_ * p.normal.force(t);
    double const needed = gravity_ - std::sin(t);
    return p.turn == 0 ? needed : spin(p).at(t).rate + needed;
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

double RollingWalk::end_of(RollingPhase const& p, Forces const& f, double end, int& what) const {
    what = of_piece;
    if (!p.contact) return end;
    auto const &w = f.w_sum, &v = f.v_sum;
    if (!v || !w) return end_of_close_rates(p, f, end, what);
    PhaseBasis const& basis = f.basis;
    Margin const turning = p.turn == 0 ? Margin() : Margin(PhaseSum{}.add(p.turn, *w));
    if (p.slip != 0) {
        Margin const slipping(PhaseSum{}.add(p.slip, *v).add(-p.slip, *w));
        double const to = first_end<2>({turning, slipping}, basis, p.start, end, what);
        what = what < 0 ? of_piece : what == 0 ? spin_stops : slip_stops;
        return to;
    }
    double const limit =
        (p.turn == 0 ? std::min(friction_, no_spin_ ? friction_ : dry_) : friction_) * tangent_;
    PhaseSum const force{
        f.n.constant, 0, f.n.sine, f.n.cosine, {0, f.n.decays[0].amplitude, f.n.decays[1].amplitude}};
    PhaseSum needed = w->derivative(basis);
    needed.add(1, {.constant = gravity_, .sine = -1});
    Margin const forwards(PhaseSum{}.add(-1, needed).add(limit, force));
    Margin const backwards(PhaseSum(needed).add(limit, force));
    double const to = first_end<3>({turning, forwards, backwards}, basis, p.start, end, what);
    constexpr std::array ends{spin_stops, friction_forwards, friction_backwards};
    what = what < 0 ? of_piece : ends[static_cast<std::size_t>(what)];
    return to;
}

double RollingWalk::end_of_close_rates(RollingPhase const& p, Forces const& f, double end, int& what) const {
    if (p.slip != 0) {
        double const to = first_end<2>(
            [&](double t) {
                Clock const clock = Clock::at(t, f.n);
                auto const a = f.v.at(clock), b = f.w.at(clock);
                return std::array{
                    p.turn == 0 ? no_zero
                                : Sample{.value = p.turn * b.value, .rate = p.turn * b.rate, .bend = b.bend},
                    Sample{.value = p.slip * (a.value - b.value),
                           .rate = p.slip * (a.rate - b.rate),
                           .bend = a.bend + b.bend}};
            },
            p.start, end, what);
        what = what < 0 ? of_piece : what == 0 ? spin_stops : slip_stops;
        return to;
    }
    double const to =
        first_end<3>([&](double t) { return without_slip(p, f.n, f.w, t); }, p.start, end, what);
    constexpr std::array ends{spin_stops, friction_forwards, friction_backwards};
    what = what < 0 ? of_piece : ends[static_cast<std::size_t>(what)];
    return to;
}

/// Margins of a phase without slip: of the spin, and of the friction force forwards and backwards.
std::array<Sample, 3> RollingWalk::without_slip(RollingPhase const& p, ContactForce const& n,
                                                Relaxation const& w, double t) const {
    Clock const c = Clock::at(t, n);
    auto const a = w.at(c);
    double force = n.constant + n.sine * c.sine + n.cosine * c.cosine;
    double change = n.sine * c.cosine - n.cosine * c.sine, bend = std::abs(n.sine) + std::abs(n.cosine);
    for (std::size_t i = 0; i < n.decays.size(); ++i) {
        double const now = n.decays[i].amplitude * c.decays[i], rate = n.decays[i].rate;
        force += now;
        change -= rate * now;
        bend += rate * rate * std::abs(now);
    }
    double const limit =
        (p.turn == 0 ? std::min(friction_, no_spin_ ? friction_ : dry_) : friction_) * tangent_;
    double spin_bend = 0;  // w'' from the equation of w
    if (p.turn != 0)
        spin_bend = (c.cosine - torque_ * a.rate - p.turn * dry_ * tangent_ * change) / (1 + inertia_);
    double const needed = a.rate + gravity_ - c.sine, needed_rate = spin_bend - c.cosine;
    auto const margin = [&](int way) {
        return Sample{.value = limit * force - way * needed,
                      .rate = limit * change - way * needed_rate,
                      .bend = limit * bend + a.jerk + 1};
    };
    Sample const turning{.value = p.turn * a.value, .rate = p.turn * a.rate, .bend = a.bend};
    return {p.turn == 0 ? no_zero : turning, margin(1), margin(-1)};
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
    double const earlier_force = same_piece ? force : tangent_ * before.normal.force(now.at.t);
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
    Forces const f = forces(p, contact);
    now.what = of_piece;
    p.end = end_of(p, f, end, now.what);
    PhaseTime const to = f.basis.at(p.end);
    bool const sums = f.v_sum && f.w_sum;
    now.s = sums ? RollingState{(*f.v_sum)(to), (*f.w_sum)(to)} : RollingState{f.v(p.end), f.w(p.end)};
    if (p.contact && p.turn == 0) now.s.w = 0;
    if (p.contact && p.slip == 0) now.s.v = now.s.w;
    if (now.what == spin_stops) now.s = {p.slip == 0 ? 0 : now.s.v, 0};
    if (now.what == slip_stops) now.s.v = now.s.w;
    now.leaving = now.what == friction_forwards ? 1 : now.what == friction_backwards ? -1 : 0;
    now.at = {to.t, to.sine, to.cosine};
    if (record == nullptr) return;
    record->travel += sums ? f.v_sum->integral(f.basis, contact.start, to) : f.v.travel(p.end);
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
            ContactForce const n = piece.force.from(now.at.t);
            double const force = n.constant + n.sine * now.at.sine + n.cosine * now.at.cosine +
                                 n.decays[0].amplitude + n.decays[1].amplitude;
            Contact const contact{n, now.at, tangent_ * force};
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
