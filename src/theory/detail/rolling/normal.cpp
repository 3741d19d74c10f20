#include "theory/detail/rolling/normal.hpp"

#include "theory/detail/common/first_zero.hpp"
#include "theory/detail/normal_orbit.hpp"

#include <algorithm>
#include <cmath>

namespace vibrotrough::theory::detail {
namespace {

constexpr double same_state = 1e-12;  // r sin(beta), omega r sin(beta)
constexpr int longest_rolling_period = 16, most_rolling_cycles = 400, kept_cycles = 200;
constexpr int most_pieces_per_cycle = 200;

struct State {
    double t, gap, rate;
    bool contact;
};

/// The soft landing: y'' = -1/Gamma + sin t + n, n = max(0, -kappa^2 y - 2 zeta kappa y') for y < 0.
class SoftLanding {
  public:
    SoftLanding(double throw_number, RollingLaw const& law)
        : weight_(1 / throw_number),
          spring_(law.stiffness * law.stiffness),
          damper_(2 * law.damping * law.stiffness) {
        double const root = std::sqrt(law.damping * law.damping - 1);
        slow_ = law.stiffness / (law.damping + root);
        fast_ = law.stiffness * (law.damping + root);
        double const size = (spring_ - 1) * (spring_ - 1) + damper_ * damper_;
        sine_ = (spring_ - 1) / size;
        cosine_ = -damper_ / size;
    }

    /// The motion that never takes off, at t = 0.
    State bound() const { return {0, -weight_ / spring_ + cosine_, sine_, true}; }

    NormalPiece piece(State const& s) const {
        NormalPiece p{.start = s.t, .end = s.t, .contact = s.contact, .gap = s.gap, .gap_rate = s.rate};
        if (!s.contact) return p;
        auto const [slow, fast] = free_parts(s);
        p.force = {.constant = weight_,
                   .sine = -1 - sine_,
                   .cosine = -cosine_,
                   .decays = {Decay{slow * slow_ * slow_, slow_}, Decay{fast * fast_ * fast_, fast_}},
                   .start = s.t};
        return p;
    }
    State at(NormalPiece const& p, double t) const {
        double const h = t - p.start;
        if (!p.contact) {
            double const c = std::cos(p.start), s = std::sin(p.start);
            return {t, p.gap + (p.gap_rate + c) * h - weight_ * h * h / 2 - (std::sin(t) - s),
                    p.gap_rate - weight_ * h - (std::cos(t) - c), false};
        }
        double const slow = p.force.decays[0].amplitude / (slow_ * slow_) * std::exp(-slow_ * h);
        double const fast = p.force.decays[1].amplitude / (fast_ * fast_) * std::exp(-fast_ * h);
        double const sine = std::sin(t), cosine = std::cos(t);
        return {t, -weight_ / spring_ + sine_ * sine + cosine_ * cosine + slow + fast,
                sine_ * cosine - cosine_ * sine - slow_ * slow - fast_ * fast, true};
    }
    /// The end of a piece that begins in state s, at most `end`.
    double end_of(NormalPiece const& p, double end) const {
        if (p.contact) {
            return first_zero([&](double t) { return pressed(p, t); }, p.start, end);
        }
        return first_zero([&](double t) { return clear(p, t); }, p.start, end);
    }

  private:
    /// Amplitudes of the two decays of y that the state leaves over from the bound motion.
    std::array<double, 2> free_parts(State const& s) const {
        double const sine = std::sin(s.t), cosine = std::cos(s.t);
        double const y = s.gap + weight_ / spring_ - sine_ * sine - cosine_ * cosine;
        double const rate = s.rate - sine_ * cosine + cosine_ * sine;
        return {(rate + fast_ * y) / (fast_ - slow_), -(rate + slow_ * y) / (fast_ - slow_)};
    }
    Sample pressed(NormalPiece const& p, double t) const {
        ContactForce const f = p.force.from(t);
        double const sine = std::sin(t), cosine = std::cos(t);
        Sample s{.value = f.constant + f.sine * sine + f.cosine * cosine,
                 .rate = f.sine * cosine - f.cosine * sine,
                 .bend = std::abs(f.sine) + std::abs(f.cosine)};
        for (Decay const& d : f.decays) {
            s.value += d.amplitude;
            s.rate -= d.amplitude * d.rate;
            s.bend += std::abs(d.amplitude) * d.rate * d.rate;
        }
        return s;
    }
    /// Contact begins as soon as both the gap and kappa^2 y + 2 zeta kappa y' are negative.
    Sample clear(NormalPiece const& p, double t) const {
        State const s = at(p, t);
        double const rate = std::sin(t) - weight_;  // y''
        double const push = spring_ * s.gap + damper_ * s.rate;
        double const bend = 1 + weight_;
        if (s.gap >= push / damper_) return {.value = s.gap, .rate = s.rate, .bend = bend};
        return {.value = push / damper_,
                .rate = spring_ / damper_ * s.rate + rate,
                .bend = 1 + spring_ / damper_ * bend};
    }

    double weight_, spring_, damper_, slow_ = 0, fast_ = 0, sine_ = 0, cosine_ = 0;
};

/// Follows the motion from s until `end` and appends its pieces.
State follow(SoftLanding const& law, State s, double end, std::vector<NormalPiece>* pieces) {
    double const most = most_pieces_per_cycle * (1 + end - s.t);
    for (int i = 0; s.t < end; ++i) {
        if (i > most) throw PhaseError("the layer chatters on the trough");
        NormalPiece p = law.piece(s);
        p.end = law.end_of(p, end);
        s = law.at(p, p.end);
        s.contact = p.end < end ? !p.contact : p.contact;
        if (pieces != nullptr && p.end > p.start) pieces->push_back(p);
    }
    return s;
}

/// The state at the next take-off within a period; at `end` if there is none.
State next_take_off(SoftLanding const& law, State s, double end) {
    while (s.t < end) {
        NormalPiece const p = law.piece(s);
        double const to = law.end_of(p, end);
        bool const done = p.contact && to < end;
        s = law.at(p, to);
        s.contact = to < end ? !p.contact : p.contact;
        if (done) return s;
    }
    return s;
}

RollingNormal soft(double throw_number, RollingLaw const& law) {
    SoftLanding const landing(throw_number, law);
    RollingNormal normal;
    normal.cycles = 0;
    State s = landing.bound();
    std::vector<State> starts;
    for (int cycle = 0; cycle < most_rolling_cycles && normal.cycles == 0; ++cycle) {
        starts.push_back(s);
        s = follow(landing, s, two_pi, nullptr);
        s.t = 0;
        for (int k = 1; k <= std::min<int>(longest_rolling_period, static_cast<int>(starts.size())); ++k) {
            State const& earlier = starts[starts.size() - static_cast<std::size_t>(k)];
            bool const same = earlier.contact == s.contact && std::abs(earlier.gap - s.gap) < same_state &&
                              std::abs(earlier.rate - s.rate) < same_state;
            if (!same) continue;
            normal.cycles = k;
            break;
        }
    }
    int const cycles = normal.cycles > 0 ? normal.cycles : kept_cycles;
    s = next_take_off(landing, s, two_pi * cycles);
    if (s.t >= two_pi * cycles) s.t = 0;  // it never takes off
    follow(landing, s, s.t + two_pi * cycles, &normal.pieces);
    return normal;
}

/// The rigid landing is that of the point mass.
RollingNormal hard(double throw_number) {
    RollingNormal normal;
    ContactForce const force{.constant = 1 / throw_number, .sine = -1};
    Forces forces;
    Conveyor conveyor{};
    conveyor.point = {throw_number, 1, 0, 1};
    forces.set(conveyor);
    NormalOrbit orbit;
    find_normal_orbit(forces, {}, orbit);
    normal.cycles = orbit.cycles;
    if (orbit.in_contact)
        normal.pieces.push_back(
            {.start = 0, .end = two_pi, .contact = true, .gap = 0, .gap_rate = 0, .force = force});
    double shift = 0;
    for (std::size_t i = orbit.first; i < orbit.hops.size(); ++i) {
        Hop const& hop = orbit.hops[i];
        if (!normal.pieces.empty())
            shift = two_pi * std::round((normal.pieces.back().end - hop.start.t) / two_pi);
        normal.pieces.push_back({.start = hop.start.t + shift,
                                 .end = hop.end.t + shift,
                                 .contact = false,
                                 .gap = 0,
                                 .gap_rate = 0});
        normal.pieces.push_back({.start = hop.end.t + shift,
                                 .end = std::max(hop.leave.t, hop.end.t) + shift,
                                 .contact = true,
                                 .gap = 0,
                                 .gap_rate = 0,
                                 .impulse = hop.approach,
                                 .force = force});
    }
    return normal;
}

}  // namespace

double ContactForce::operator()(double t) const {
    double sum = constant + sine * std::sin(t) + cosine * std::cos(t);
    for (Decay const& d : decays) {
        if (d.amplitude != 0) sum += d.amplitude * std::exp(-d.rate * (t - start));
    }
    return sum;
}

ContactForce ContactForce::from(double t) const {
    if (t == start) return *this;
    ContactForce moved = *this;
    for (Decay& d : moved.decays) {
        if (d.amplitude != 0) d.amplitude *= std::exp(-d.rate * (t - start));
    }
    moved.start = t;
    return moved;
}

ContactForce ContactForce::scaled(double factor) const {
    ContactForce result = *this;
    result.constant *= factor;
    result.sine *= factor;
    result.cosine *= factor;
    for (Decay& d : result.decays) d.amplitude *= factor;
    return result;
}

RollingNormal find_rolling_normal(double throw_number, RollingLaw const& law) {
    return std::isinf(law.stiffness) ? hard(throw_number) : soft(throw_number, law);
}

std::array<double, 2> gap_at(NormalPiece const& piece, double t, double throw_number, RollingLaw const& law) {
    if (std::isinf(law.stiffness)) {
        if (piece.contact) return {0, 0};
        double const h = t - piece.start, c = std::cos(piece.start), s = std::sin(piece.start);
        return {c * h - h * h / (2 * throw_number) - (std::sin(t) - s),
                -h / throw_number - (std::cos(t) - c)};
    }
    State const s = SoftLanding(throw_number, law).at(piece, t);
    return {s.gap, s.rate};
}

}  // namespace vibrotrough::theory::detail
