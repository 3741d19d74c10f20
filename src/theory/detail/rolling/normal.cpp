#include "theory/detail/rolling/normal.hpp"

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

/// y'' = -1/Gamma + sin t from a height and its rate (Eqs. 12-14).
PhaseSum ballistic(double weight, Instant const& start, double gap, double rate) {
    return {.constant = gap + start.sine, .slope = rate + start.cosine, .square = -weight / 2, .sine = -1};
}

/// The soft landing: y'' = -1/Gamma + sin t + n, n = max(0, -kappa^2 y - 2 zeta kappa y') for y < 0.
class SoftLanding {
  public:
    SoftLanding(double throw_number, RollingLaw const& law)
        : weight_(1 / throw_number),
          spring_(law.stiffness * law.stiffness),
          damper_(2 * law.damping * law.stiffness),
          rates_(landing_rates(law)) {
        double const size = (spring_ - 1) * (spring_ - 1) + damper_ * damper_;
        sine_ = (spring_ - 1) / size;
        cosine_ = -damper_ / size;
    }

    /// The motion that never takes off, at t = 0.
    State bound() const { return {0, -weight_ / spring_ + cosine_, sine_, true}; }

    /// The piece that begins in a state and ends at `end` at the latest, and the state after it.
    NormalPiece follow(State& s, double end) const {
        Instant const start = Instant::at(s.t);
        NormalPiece p{
            .start = s.t, .end = end, .contact = s.contact, .basis = {s.t, {0, rates_[0], rates_[1]}}};
        p.gap = s.contact ? pressed(start, s) : ballistic(weight_, start, s.gap, s.rate);
        if (s.contact) p.force = force(p.gap, p.basis);
        p.end = s.contact ? release(p, end) : landing(p, end);
        PhaseTime const to = p.basis.at(p.end);
        bool const whole = p.end >= end;
        s = {p.end, p.gap(to), p.gap.derivative(p.basis)(to), whole ? s.contact : !s.contact};
        return p;
    }

  private:
    /// The height in contact: the bound motion, and two decays that the state leaves over from it.
    PhaseSum pressed(Instant const& start, State const& s) const {
        double const y = s.gap + weight_ / spring_ - sine_ * start.sine - cosine_ * start.cosine;
        double const rate = s.rate - sine_ * start.cosine + cosine_ * start.sine;
        double const slow = rates_[0], fast = rates_[1];
        return {.constant = -weight_ / spring_,
                .sine = sine_,
                .cosine = cosine_,
                .decays = {0, (rate + fast * y) / (fast - slow), -(rate + slow * y) / (fast - slow)}};
    }
    /// n = y'' + 1/Gamma - sin t
    PhaseSum force(PhaseSum const& gap, PhaseBasis const& basis) const {
        PhaseSum n{.constant = weight_, .sine = -1};
        return n.add(1, gap.derivative(basis).derivative(basis));
    }
    static double release(NormalPiece const& p, double end) {
        int which = -1;
        return first_end<1>({Margin(p.force)}, p.basis, p.start, end, which);
    }
    /// Contact begins as soon as the layer is below the trough's surface and spring and damper push.
    double landing(NormalPiece const& p, double end) const {
        double from = p.start;
        int which = 0;
        if (p.gap(p.basis.at(from)) < 0) {
            Margin const pulls(PhaseSum(p.gap.derivative(p.basis)).add(spring_ / damper_, p.gap));
            Margin const below(PhaseSum{}.add(-1, p.gap));
            from = first_end<2>({pulls, below}, p.basis, from, end, which);
            if (which != 1) return from;
        }
        return first_end<1>({Margin(p.gap)}, p.basis, from, end, which);
    }

    double weight_, spring_, damper_;
    std::array<double, 2> rates_;
    double sine_ = 0, cosine_ = 0;
};

/// Follows the motion from s until `end` and appends its pieces.
State follow(SoftLanding const& law, State s, double end, std::vector<NormalPiece>* pieces) {
    double const most = most_pieces_per_cycle * (1 + end - s.t);
    for (int i = 0; s.t < end; ++i) {
        if (i > most) throw PhaseError("the layer chatters on the trough");
        NormalPiece const p = law.follow(s, end);
        if (pieces != nullptr && p.end > p.start) pieces->push_back(p);
    }
    return s;
}

/// The state at the next take-off within a period; at `end` if there is none.
State next_take_off(SoftLanding const& law, State s, double end) {
    while (s.t < end) {
        bool const pressed = s.contact;
        law.follow(s, end);
        if (pressed && !s.contact) break;
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
        auto const repeats = [&](State const& earlier) {
            return earlier.contact == s.contact && std::abs(earlier.gap - s.gap) < same_state &&
                   std::abs(earlier.rate - s.rate) < same_state;
        };
        for (std::size_t k = 1; k <= longest_rolling_period && k <= starts.size() && normal.cycles == 0; ++k)
            if (repeats(starts[starts.size() - k])) normal.cycles = static_cast<int>(k);
    }
    int const cycles = normal.cycles > 0 ? normal.cycles : kept_cycles;
    s = next_take_off(landing, s, two_pi * cycles);
    if (s.t >= two_pi * cycles) s.t = 0;  // it never takes off
    follow(landing, s, s.t + two_pi * cycles, &normal.pieces);
    return normal;
}

/// The rigid landing is that of the point mass: its flights and contacts.
RollingNormal hard(double throw_number) {
    Conveyor conveyor{};
    conveyor.point = {throw_number, 1, 0, 1};
    Forces forces;
    forces.set(conveyor);
    NormalOrbit orbit;
    find_normal_orbit(forces, {}, orbit);
    RollingNormal normal;
    normal.cycles = orbit.cycles;
    double const weight = forces.weight();
    auto const touch = [&](double from, double to, double impulse) {
        normal.pieces.push_back({.start = from,
                                 .end = to,
                                 .contact = true,
                                 .impulse = impulse,
                                 .basis = {from},
                                 .force = {.constant = weight, .sine = -1}});
    };
    if (orbit.in_contact) touch(0, two_pi, 0);
    for (std::size_t i = orbit.first; i < orbit.hops.size(); ++i) {
        Hop const& hop = orbit.hops[i];
        double const last = normal.pieces.empty() ? hop.start.t : normal.pieces.back().end;
        double const shift = two_pi * std::round((last - hop.start.t) / two_pi);
        double const start = hop.start.t + shift, end = hop.end.t + shift;
        normal.pieces.push_back({.start = start,
                                 .end = end,
                                 .contact = false,
                                 .basis = {start},
                                 .gap = ballistic(weight, hop.start, 0, 0)});
        touch(end, std::max(hop.leave.t + shift, end), hop.approach);
    }
    return normal;
}

}  // namespace

std::array<double, 2> landing_rates(RollingLaw const& law) {
    double const root = std::sqrt(law.damping * law.damping - 1);
    return {law.stiffness / (law.damping + root), law.stiffness * (law.damping + root)};
}

RollingNormal find_rolling_normal(double throw_number, RollingLaw const& law) {
    return std::isinf(law.stiffness) ? hard(throw_number) : soft(throw_number, law);
}

}  // namespace vibrotrough::theory::detail
