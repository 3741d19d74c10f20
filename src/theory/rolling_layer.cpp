#include "theory/rolling_layer.hpp"

#include "theory/detail/ranges.hpp"
#include "theory/detail/rolling/search.hpp"
#include "theory/detail/rolling/walk.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace vibrotrough::theory {
namespace {

using detail::Instant;
using detail::RollingNormal;
using detail::RollingSearch;
using detail::RollingWalk;
using detail::two_pi;

constexpr double shortest_phase = 1e-9;  // rad; shorter phases are rounding errors, not motion

struct Constant {
    char const* name;
    double RollingLaw::*value;
};

constexpr std::array<Constant, 5> constants{{{"torque", &RollingLaw::torque},
                                             {"dry_torque", &RollingLaw::dry_torque},
                                             {"spin_inertia", &RollingLaw::spin_inertia},
                                             {"stiffness", &RollingLaw::stiffness},
                                             {"damping", &RollingLaw::damping}}};

void check_constants(RollingLaw const& law) {
    using detail::require_range;
    auto const within = [](double x, double low, double high) { return x >= low && x <= high; };
    require_range(within(law.torque, 1e-6, 1e6) || std::isinf(law.torque), "torque", law.torque,
                  "[1e-6, 1e6] or inf");
    require_range(within(law.dry_torque, 0, 1e6), "dry_torque", law.dry_torque, "[0, 1e6]");
    require_range(within(law.spin_inertia, 1e-6, 1e3), "spin_inertia", law.spin_inertia, "[1e-6, 1000]");
    require_range(within(law.stiffness, 2, 1e3) || std::isinf(law.stiffness), "stiffness", law.stiffness,
                  "[2, 1000] or inf");
    require_range(within(law.damping, 1.01, 100), "damping", law.damping, "[1.01, 100]");
}

std::string inputs_text(RollingLayer const& layer) {
    std::string text = detail::inputs_text(layer.point);
    for (Constant const& c : constants)
        text += std::string(" ") + c.name + "=" + detail::number_text(layer.law.*c.value);
    return text;
}

PhaseKind kind_of(double velocity, bool contact, bool landed) {
    if (!contact) return PhaseKind::flight;
    if (velocity == 0) return PhaseKind::rest;
    if (velocity > 0) return landed ? PhaseKind::positive_slide_after_landing : PhaseKind::positive_slide;
    return landed ? PhaseKind::negative_slide_after_landing : PhaseKind::negative_slide;
}

/// Collects the phases of the layer: rolling and slipping parts with the same direction are one slide.
class PhaseList {
  public:
    void add(RollingPhase const& p) {
        auto const travelled = [&](double t) {
            return p.v.integral(p.basis, Instant::at(p.start), p.basis.at(t));
        };
        if (!p.contact) {
            append(PhaseKind::flight, p.start, p.end, travelled(p.end));
            landed_ = true;
            return;
        }
        double t = p.start;
        while (t < p.end) {
            double const sign = sign_after(p, t);
            double const to = sign == 0 ? p.end : zero_after(p, sign, t);
            append(kind_of(sign, true, landed_), t, to, travelled(to) - travelled(t));
            t = to;
        }
    }
    std::vector<Phase> take() && { return std::move(phases_); }

  private:
    /// The sign of v just after t.
    static double sign_after(RollingPhase const& p, double t) {
        double const now = p.v(p.basis.at(t));
        if (std::abs(now) > 1e-12) return now;
        double const later = p.v(p.basis.at(t + std::min(1e-6, (p.end - t) / 2)));
        return std::abs(later) > 1e-15 ? later : 0;
    }
    static double zero_after(RollingPhase const& p, double sign, double t) {
        int which = -1;
        detail::Margin const remains(detail::PhaseSum{}.add(std::copysign(1.0, sign), p.v));
        return detail::first_end<1>({remains}, p.basis, std::min(t + 1e-7, p.end), p.end, which);
    }
    void append(PhaseKind kind, double start, double end, double moved) {
        bool const same = !phases_.empty() && phases_.back().kind == kind;
        if (same || (!phases_.empty() && end - start < shortest_phase)) {
            phases_.back().end = end;
            phases_.back().relative_displacement += moved;
            return;
        }
        bool const after = kind == PhaseKind::positive_slide_after_landing ||
                           kind == PhaseKind::negative_slide_after_landing;
        if (after || kind == PhaseKind::rest) landed_ = false;
        if (!phases_.empty() && continues(phases_.back().kind, kind)) {
            phases_.back().end = end;
            phases_.back().relative_displacement += moved;
            return;
        }
        phases_.push_back({kind, start, end, moved});
    }
    /// P after P', and N after N', continue the same slide.
    static bool continues(PhaseKind before, PhaseKind now) {
        return (before == PhaseKind::positive_slide_after_landing && now == PhaseKind::positive_slide) ||
               (before == PhaseKind::negative_slide_after_landing && now == PhaseKind::negative_slide);
    }

    std::vector<Phase> phases_;
    bool landed_ = false;
};

/// Without a flight the list starts with a positive slide, or with a negative one if there is none.
void rotate_to_slide(std::vector<Phase>& phases) {
    if (phases.size() > 1 && phases.front().kind == phases.back().kind) {
        phases.front().start = phases.back().start - two_pi;
        phases.front().relative_displacement += phases.back().relative_displacement;
        phases.pop_back();
    }
    for (auto const kind : {PhaseKind::positive_slide, PhaseKind::negative_slide}) {
        auto const first =
            std::find_if(phases.begin(), phases.end(), [&](Phase const& p) { return p.kind == kind; });
        if (first == phases.end()) continue;
        for (auto p = phases.begin(); p != first; ++p) {
            p->start += two_pi;
            p->end += two_pi;
        }
        std::rotate(phases.begin(), first, phases.end());
        return;
    }
}

void describe(Motion& motion, std::vector<Phase> phases, int cycles) {
    bool const flies =
        std::any_of(phases.begin(), phases.end(), [](Phase const& p) { return p.kind == PhaseKind::flight; });
    if (!flies) rotate_to_slide(phases);
    double const shift = two_pi * std::floor(phases.front().start / two_pi);
    for (Phase& p : phases) {
        p.start -= shift;
        p.end -= shift;
        motion.mode += to_string(p.kind);
        if (p.kind == PhaseKind::flight)
            motion.flight_number = std::max(motion.flight_number, (p.end - p.start) / two_pi);
    }
    motion.phases = std::move(phases);
    motion.period_cycles = cycles;
    motion.converged = true;
}

RollingMotion endless(PointMass const& point) {
    RollingMotion answer{};
    bool const level = point.tan_inclination == 0;
    answer.motion.velocity_efficiency =
        level ? 0 : std::copysign(std::numeric_limits<double>::infinity(), -point.tan_inclination);
    answer.motion.outcome = level ? Outcome::indifferent : Outcome::runs_away;
    return answer;
}

}  // namespace

std::vector<std::string_view> const& rolling_constants() {
    static std::vector<std::string_view> const names = [] {
        std::vector<std::string_view> all;
        for (Constant const& c : constants) all.emplace_back(c.name);
        return all;
    }();
    return names;
}

RollingLaw law_of_grains(double rolling_friction) {
    RollingLaw law;
    law.dry_torque += rolling_friction;
    return law;
}

bool set_constant(RollingLaw& law, std::string_view name, double value) {
    for (Constant const& c : constants) {
        if (name != c.name) continue;
        law.*c.value = value;
        return true;
    }
    return false;
}

struct RollingLayerSolver::Memory {
    RollingLaw law;
    double throw_number = 0;  // that `normal` belongs to
    RollingNormal normal;
    RollingSearch search;  // with what is known from the last points
    RollingWalk::Record record;

    RollingMotion solve(PointMass const& point);
};

RollingMotion RollingLayerSolver::Memory::solve(PointMass const& point) {
    bool const slides_away = std::abs(point.tan_inclination) > point.friction;
    if (slides_away || (point.friction == 0 && point.tan_inclination == 0)) return endless(point);
    if (point.throw_number != throw_number) {
        search.forget();
        throw_number = 0;  // stays so if the next line throws
        normal = detail::find_rolling_normal(point.throw_number, law);
        throw_number = point.throw_number;
    }
    RollingLayer const layer{point, law};
    RollingWalk const walk(layer);
    double const length = normal.pieces.back().end - normal.pieces.front().start;
    bool const repeats = search.settle(walk, normal, record) && normal.cycles > 0;
    RollingMotion answer{};
    answer.motion.velocity_efficiency = record.travel / length;
    if (!repeats) {
        answer.motion.outcome = Outcome::unsettled;
        return answer;
    }
    answer.motion.outcome = Outcome::periodic;
    auto period = std::make_shared<RollingPeriod>();
    period->phases = record.phases;
    period->layer = layer;
    period->start = normal.pieces.front().start;
    period->end = normal.pieces.back().end;
    PhaseList list;
    for (RollingPhase const& p : period->phases) list.add(p);
    describe(answer.motion, std::move(list).take(), normal.cycles);
    answer.period = std::move(period);
    return answer;
}

RollingLayerSolver::RollingLayerSolver(RollingLaw const& law) : memory_(std::make_unique<Memory>()) {
    check_constants(law);
    memory_->law = law;
}
RollingLayerSolver::~RollingLayerSolver() = default;
RollingLayerSolver::RollingLayerSolver(RollingLayerSolver&&) noexcept = default;
RollingLayerSolver& RollingLayerSolver::operator=(RollingLayerSolver&&) noexcept = default;

RollingMotion RollingLayerSolver::operator()(PointMass const& point) {
    detail::check_ranges(point);
    try {
        return memory_->solve(point);
    } catch (PhaseError const& error) {
        throw PhaseError(std::string(error.what()) + " (" + inputs_text({point, memory_->law}) + ")");
    }
}

RollingMotion solve(RollingLayer const& layer) {
    return RollingLayerSolver(layer.law)(layer.point);
}

std::vector<RollingSample> trace(RollingMotion const& motion, int count) {
    if (!motion.period || count < 2)
        throw std::invalid_argument("a trace needs a motion with a period and two samples");
    RollingPeriod const& period = *motion.period;
    RollingWalk const walk(period.layer);
    std::vector<RollingSample> samples;
    std::size_t i = 0;
    for (int k = 0; k < count; ++k) {
        double const t = period.start + (period.end - period.start) * k / (count - 1);
        while (i + 1 < period.phases.size() && t >= period.phases[i].end) ++i;
        RollingPhase const& p = period.phases[i];
        detail::PhaseTime const at = p.basis.at(t), in_piece = p.normal.basis.at(t);
        detail::PhaseSum const gap_rate = p.normal.gap.derivative(p.normal.basis);
        samples.push_back({.t = t,
                           .kind = kind_of(p.v(at), p.contact, false),
                           .velocity = p.v(at),
                           .spin = p.w(at),
                           .gap = p.normal.gap(in_piece),
                           .gap_rate = gap_rate(in_piece),
                           .normal_force = p.n(at),
                           .tangential_force = walk.friction_force(p, t)});
    }
    return samples;
}

}  // namespace vibrotrough::theory
