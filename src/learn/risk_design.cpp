#include "learn/risk_design.hpp"

#include "theory/efficiency.hpp"
#include "theory/quantities.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <boost/math/special_functions/erf.hpp>
#include <fmt/format.h>
#include <nlopt.hpp>

namespace vibrotrough::learn {
namespace {

using Variables = std::vector<double>;  // log frequency, log amplitude, vibration angle, inclination

constexpr double pi = std::numbers::pi;
constexpr int frictions = 15;  // quantiles that stand for the distribution of the friction
constexpr int global_evaluations = 20000, local_evaluations = 3000;

double normal_quantile(double p) {
    return -std::sqrt(2.0) * boost::math::erfc_inv(2 * p);
}
double normal_share_above(double z) {
    return 0.5 * std::erfc(z / std::sqrt(2.0));
}

/// A machine as the search sees it.
struct Machine {
    double frequency, amplitude, vibration_angle, inclination;
    double omega() const { return 2 * pi * frequency; }
    double trough_speed() const { return omega() * amplitude * std::cos(vibration_angle); }
    double machine_number(double gravity) const { return omega() * omega() * amplitude / gravity; }
    double throw_number(double gravity) const {
        return machine_number(gravity) * std::sin(vibration_angle) / std::cos(inclination);
    }
};

/// Speeds of a machine over the distribution of the friction and of the theory's error.
struct SpeedDistribution {
    std::vector<double> speeds;  ///< m/s, one per friction, each as likely
    double sd;                   ///< m/s, of the theory's error

    double probability_above(double speed) const {
        double sum = 0;
        for (double const v : speeds)
            sum += sd > 0 ? normal_share_above((speed - v) / sd) : (v >= speed ? 1 : 0);
        return sum / static_cast<double>(speeds.size());
    }
    /// The speed that is exceeded with a probability.
    double exceeded_with(double probability) const {
        auto const [least, most] = std::ranges::minmax(speeds);
        double low = least - 6 * sd, high = most + 6 * sd;
        for (int i = 0; i < 50; ++i) {
            double const middle = (low + high) / 2;
            (probability_above(middle) >= probability ? low : high) = middle;
        }
        return low;
    }
};

class RiskSearch {
  public:
    explicit RiskSearch(DesignTask const& task) : task_(task), solvers_(frictions) {
        for (int i = 0; i < frictions; ++i)
            frictions_.push_back(
                std::max(0.01, task.friction + task.friction_sd * normal_quantile((i + 0.5) / frictions)));
        needed_ = task.mass_flow / (task.bulk_density * task.width * task.depth.high);
    }

    static Machine machine(Variables const& x) { return {std::exp(x[0]), std::exp(x[1]), x[2], x[3]}; }

    SpeedDistribution speeds(Machine const& m) {
        SpeedDistribution d{{}, task_.discrepancy * m.trough_speed()};
        double const gamma = std::clamp(m.throw_number(task_.limits.gravity), 1e-6, 1e4);
        for (int i = 0; i < frictions; ++i) {
            auto const k = static_cast<std::size_t>(i);
            double const eta =
                solvers_[k]({gamma, std::tan(m.vibration_angle), std::tan(m.inclination), frictions_[k]})
                    .velocity_efficiency;
            d.speeds.push_back(std::isfinite(eta) ? eta * m.trough_speed() : -1e3);  // runs away: not usable
        }
        return d;
    }

    /// The motion at the median of the friction in SI units.
    theory::EngineerQuantities quantities(Machine const& m) const {
        theory::Conveyor conveyor{};
        conveyor.point = {m.throw_number(task_.limits.gravity), std::tan(m.vibration_angle),
                          std::tan(m.inclination), task_.friction};
        try {
            return theory::engineer_quantities(theory::solve_plastic(conveyor, theory::Detail::pieces),
                                               {m.amplitude, task_.limits.gravity});
        } catch (std::invalid_argument const&) {
            return {};  // it runs away
        }
    }

    double sure_speed(Machine const& m) { return speeds(m).exceeded_with(task_.confidence); }

    /// What is made as large as possible, once the mass flow is reached.
    double merit(Machine const& m) {
        switch (task_.objective) {
            case Objective::fastest:
                return sure_speed(m);
            case Objective::gentlest_landing:
                return -quantities(m).impact_speed;
            case Objective::least_machine_number:
                return -m.machine_number(task_.limits.gravity);
            case Objective::least_power:
                return -quantities(m).mean_power /
                       std::max(1e-9, sure_speed(m));  // of the layer that carries the flow
        }
        return 0;
    }

    DesignTask const& task() const { return task_; }
    double needed() const { return needed_; }

  private:
    DesignTask const& task_;
    std::vector<theory::EfficiencySolver> solvers_;  // one per friction: each remembers its last motion
    std::vector<double> frictions_;
    double needed_;  // m/s, at the largest depth
};

double objective(Variables const& x, Variables&, void* self) {
    auto& search = *static_cast<RiskSearch*>(self);
    return search.merit(RiskSearch::machine(x));
}
double fastest(Variables const& x, Variables&, void* self) {
    auto& search = *static_cast<RiskSearch*>(self);
    return search.sure_speed(RiskSearch::machine(x));
}
double too_slow(Variables const& x, Variables&, void* self) {
    auto& search = *static_cast<RiskSearch*>(self);
    return search.needed() - search.sure_speed(RiskSearch::machine(x));
}
double over_machine_number(Variables const& x, Variables&, void* self) {
    auto const& l = static_cast<RiskSearch*>(self)->task().limits;
    return std::log(RiskSearch::machine(x).machine_number(l.gravity) / l.max_machine_number);
}
double over_throw_number(Variables const& x, Variables&, void* self) {
    auto const& l = static_cast<RiskSearch*>(self)->task().limits;
    return std::log(RiskSearch::machine(x).throw_number(l.gravity) / l.max_throw_number);
}
double over_landing_speed(Variables const& x, Variables&, void* self) {
    auto const& search = *static_cast<RiskSearch*>(self);
    return search.quantities(RiskSearch::machine(x)).impact_speed - *search.task().landing_speed;
}

Variables optimised(RiskSearch& search, nlopt::algorithm algorithm, Variables x, int evaluations,
                    nlopt::vfunc what, bool must_reach) {
    theory::DesignLimits const& l = search.task().limits;
    nlopt::opt optimiser(algorithm, 4);
    optimiser.set_lower_bounds(
        {std::log(l.frequency.low), std::log(l.amplitude.low), l.vibration_angle.low, l.inclination.low});
    optimiser.set_upper_bounds(
        {std::log(l.frequency.high), std::log(l.amplitude.high), l.vibration_angle.high, l.inclination.high});
    optimiser.set_max_objective(what, &search);
    optimiser.add_inequality_constraint(over_machine_number, &search, 1e-6);
    optimiser.add_inequality_constraint(over_throw_number, &search, 1e-6);
    if (search.task().landing_speed) optimiser.add_inequality_constraint(over_landing_speed, &search, 1e-6);
    if (must_reach) optimiser.add_inequality_constraint(too_slow, &search, 1e-6);
    optimiser.set_maxeval(evaluations);
    optimiser.set_xtol_rel(1e-5);
    double value = 0;
    try {
        optimiser.optimize(x, value);
    } catch (nlopt::roundoff_limited const&) {
        return x;  // as good as rounding allows
    }
    return x;
}

Variables best(RiskSearch& search, nlopt::vfunc what, Variables start, bool must_reach) {
    nlopt::srand(1);
    Variables const rough =
        optimised(search, nlopt::GN_ISRES, std::move(start), global_evaluations, what, must_reach);
    return optimised(search, nlopt::LN_COBYLA, rough, local_evaluations, what, must_reach);
}

void check(DesignTask const& t) {
    auto const inside = [](theory::Range const& r, double low, double high) {
        return r.low >= low && r.low <= r.high && r.high <= high;
    };
    theory::DesignLimits const& l = t.limits;
    bool const drive = inside(l.frequency, 1e-3, 1e4) && inside(l.amplitude, 1e-7, 10) &&
                       inside(l.vibration_angle, 1e-6, 1.57) && inside(l.inclination, -1.57, 1.57) &&
                       l.max_machine_number > 0 && l.max_throw_number > 0;
    bool const material = t.friction > 0 && t.friction_sd >= 0 && t.discrepancy >= 0 && t.bulk_density > 0;
    bool const trough =
        t.width > 0 && t.length >= 0 && t.mass_flow > 0 && t.depth.low > 0 && t.depth.low <= t.depth.high;
    if (!drive || !material || !trough || !(t.confidence >= 0.5 && t.confidence <= 0.999))
        throw std::invalid_argument("a limit of the design is out of range");
}

/// The limits that a design lies on, within one per cent of their range.
std::vector<std::string> limits_at(DesignTask const& t, Machine const& m, RiskDesign const& d) {
    std::vector<std::string> active;
    auto const ends = [&](char const* name, double value, theory::Range const& r, double in_unit,
                          char const* unit) {
        double const slack = 0.01 * std::max(r.high - r.low, 1e-9);
        if (r.high == r.low) return;
        if (value > r.high - slack)
            active.push_back(fmt::format("{} <= {:.4g}{}", name, in_unit * r.high, unit));
        if (value < r.low + slack)
            active.push_back(fmt::format("{} >= {:.4g}{}", name, in_unit * r.low, unit));
    };
    theory::DesignLimits const& l = t.limits;
    if (m.machine_number(l.gravity) > 0.99 * l.max_machine_number)
        active.push_back(fmt::format("machine number <= {:.4g}", l.max_machine_number));
    if (m.throw_number(l.gravity) > 0.99 * l.max_throw_number)
        active.push_back(fmt::format("throw number <= {:.4g}", l.max_throw_number));
    if (t.landing_speed && d.landing_speed > 0.99 * *t.landing_speed)
        active.push_back(fmt::format("landing speed <= {:.4g} m/s", *t.landing_speed));
    ends("frequency", m.frequency, l.frequency, 60, " rpm");
    ends("stroke", m.amplitude, l.amplitude, 2000, " mm");
    ends("vibration angle", m.vibration_angle, l.vibration_angle, 180 / pi, " degrees");
    ends("inclination", m.inclination, l.inclination, 180 / pi, " degrees");
    if (d.depth > 0.99 * t.depth.high)
        active.push_back(fmt::format("layer depth <= {:.4g} mm", 1e3 * t.depth.high));
    return active;
}

}  // namespace

std::optional<double> known_factor(double throw_number) {
    // Layer over theory of validation/demo: 0.672 / 0.344 at 1.70, 0.780 / 0.410, 0.824 / 0.581, 0.877 /
    // 0.758 at 2.20, 0.927 / 0.927 at 2.50.
    constexpr std::array<double, 5> at{1.70, 1.85, 2.00, 2.20, 2.50}, factor{1.95, 1.90, 1.42, 1.16, 1.00};
    if (throw_number < 1.2 || throw_number > 2.3) return {};
    if (throw_number <= at.front()) return factor.front();
    std::size_t i = 1;
    while (at[i] < throw_number) ++i;
    double const share = (throw_number - at[i - 1]) / (at[i] - at[i - 1]);
    return factor[i - 1] + share * (factor[i] - factor[i - 1]);
}

double rule_of_thumb(double frequency, double amplitude) {
    return 3.81 * (60 * frequency) * amplitude / 60;
}

RiskDesign design_with_risk(DesignTask const& task) {
    check(task);
    RiskSearch search(task);
    theory::DesignLimits const& l = task.limits;
    Variables const middle{(std::log(l.frequency.low) + std::log(l.frequency.high)) / 2,
                           (std::log(l.amplitude.low) + std::log(l.amplitude.high)) / 2,
                           (l.vibration_angle.low + l.vibration_angle.high) / 2,
                           (l.inclination.low + l.inclination.high) / 2};
    Variables x = best(search, fastest, middle, false);
    RiskDesign d{};
    d.sure_speed = search.sure_speed(RiskSearch::machine(x));
    d.feasible = d.sure_speed >= search.needed() * (1 - 1e-6);
    if (d.feasible && task.objective != Objective::fastest) x = best(search, objective, x, true);
    Machine const m = RiskSearch::machine(x);
    SpeedDistribution const speeds = search.speeds(m);
    d.sure_speed = speeds.exceeded_with(task.confidence);
    double const per_speed = task.bulk_density * task.width;  // kg/s for each m of depth and m/s of speed
    d.depth = d.sure_speed > 0
                  ? std::clamp(task.mass_flow / (per_speed * d.sure_speed), task.depth.low, task.depth.high)
                  : task.depth.high;
    double const flow = per_speed * d.depth;
    d.low_flow = flow * speeds.exceeded_with(0.975);
    d.median_flow = flow * speeds.exceeded_with(0.5);
    d.high_flow = flow * speeds.exceeded_with(0.025);
    d.probability = speeds.probability_above(task.mass_flow / flow * (1 - 1e-9));
    auto const quantities = search.quantities(m);
    d.landing_speed = quantities.impact_speed;
    if (task.length > 0)
        d.power = quantities.mean_power * task.bulk_density * task.width * d.depth * task.length;
    theory::EfficiencySolver solver;
    theory::Efficiency const at_median = solver(
        {m.throw_number(l.gravity), std::tan(m.vibration_angle), std::tan(m.inclination), task.friction});
    d.machine = {m.frequency,
                 m.amplitude,
                 m.vibration_angle,
                 m.inclination,
                 m.throw_number(l.gravity),
                 m.machine_number(l.gravity),
                 at_median.velocity_efficiency,
                 at_median.velocity_efficiency * m.trough_speed(),
                 flow * at_median.velocity_efficiency * m.trough_speed(),
                 theory::to_string(at_median.mode),
                 d.feasible,
                 {}};
    d.active_limits = limits_at(task, m, d);
    if (auto const factor = known_factor(d.machine.throw_number)) {
        d.warnings.push_back(
            fmt::format("At throw number {:.2f} layers of grains that roll were conveyed about {:.2g} times "
                        "as fast as the theory says (validation/demo): the "
                        "design is then on the safe side for the mass flow, but the layer is thinner and the "
                        "landing may differ.",
                        d.machine.throw_number, *factor));
    }
    return d;
}

}  // namespace vibrotrough::learn
