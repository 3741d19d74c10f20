#include "learn/risk_design.hpp"

#include "core/error.hpp"
#include "learn/budget.hpp"
#include "learn/machine_keys.hpp"
#include "learn/risk_search.hpp"
#include "learn/way_out.hpp"
#include "theory/quantities.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::learn {
namespace {

constexpr double near_limit = 0.01;     // relative: a limit so close counts as active
constexpr double depth_step = 1e-4;     // m, to which the depth is rounded up
constexpr double largest_loss = 0.005;  // of the merit, by rounding the drive
constexpr int exchanges = 8;
constexpr double same_depth = 0.02;  // relative, between the layer of a design and that of its models
constexpr int most_depths = 8;
constexpr int corrections = 3;             // of what the search expects of the sure speed
constexpr double least_draws_in_tail = 5;  // of a posterior, beyond the confidence

void check(DesignTask const& t) {
    theory::check(t.space);
    bool const material = t.friction.low > 0 && t.bulk_density > 0;
    bool const trough = t.width > 0 && t.length >= 0 && t.mass_flow > 0 && t.depth.low > 0 &&
                        t.depth.low <= t.depth.high && (!t.landing_speed || *t.landing_speed > 0);
    bool const models = !t.models.empty() && std::ranges::all_of(t.models, [](DesignModel const& m) {
        return !m.discrepancy || *m.discrepancy >= 0;
    });
    if (!material || !trough || !models || !(t.confidence >= 0.5 && t.confidence <= 0.999))
        throw std::invalid_argument("a number of the design is out of range");
    auto const draws = static_cast<double>(t.friction.draws.size());
    if (draws > 0 && (1 - t.confidence) * draws < least_draws_in_tail - 1e-9) {
        throw core::InputError(fmt::format(
            "a confidence of {:g} cannot be resolved: of the {:g} draws of the posterior fewer than {:g} lie "
            "beyond it; ask for at most {:.4g}",
            t.confidence, draws, least_draws_in_tail,
            std::floor(1e4 * (1 - least_draws_in_tail / draws)) / 1e4));
    }
}

/// The best drive that keeps the limit of the landing speed at every friction.
std::optional<theory::Drive> best_at_every_friction(RiskSearch& search, Objective objective,
                                                    bool must_reach) {
    for (int i = 0; i < exchanges; ++i) {
        auto const drive = search.best(objective, must_reach);
        if (!drive || !search.task().landing_speed) return drive;
        auto const worst = search.worst_landing(*drive);
        if (worst.speed <= *search.task().landing_speed) return drive;
        search.keep_landing_at(worst.friction, worst.speed);
    }
    return {};
}

/// A value on a grid of a step, below or above, within its range. A value that is fixed stays.
double on_grid(double value, theory::Range const& r, double step, bool above) {
    if (r.low == r.high) return value;
    double const count = above ? std::ceil(value / step - 1e-9) : std::floor(value / step + 1e-9);
    double rounded = count * step;
    if (std::abs(rounded - r.high) < 1e-9 * step) rounded = r.high;
    if (std::abs(rounded - r.low) < 1e-9 * step) rounded = r.low;
    return rounded >= r.low && rounded <= r.high ? rounded : std::clamp(value, r.low, r.high);
}

theory::Drive rounded(theory::Drive const& d, theory::DriveSpace const& s, double scale, unsigned corner) {
    auto const above = [&](unsigned bit) { return (corner >> bit & 1U) != 0; };
    return {on_grid(d.frequency, s.frequency, scale / 60, above(0)),
            on_grid(d.amplitude, s.amplitude, scale * 5e-5, above(1)),
            on_grid(d.vibration_angle, s.vibration_angle, scale * degree / 2, above(2)),
            on_grid(d.inclination, s.inclination, scale * degree / 2, above(3))};
}

/// The drive on the coarsest grid that costs little and keeps every limit; as it is when there is none.
theory::Drive rounded(RiskSearch& search, theory::Drive const& drive, Objective objective, bool must_reach) {
    double const merit = search.merit(drive, objective);
    for (double scale : {1.0, 0.1, 0.01, 0.001}) {
        std::vector<std::pair<double, theory::Drive>> candidates;
        for (unsigned corner = 0; corner < 16; ++corner) {
            theory::Drive const one = rounded(drive, search.space(), scale, corner);
            double const value = search.merit(one, objective);
            if (value >= merit - largest_loss * std::abs(merit)) candidates.emplace_back(value, one);
        }
        std::ranges::stable_sort(candidates, std::greater(), &std::pair<double, theory::Drive>::first);
        for (auto const& [value, one] : candidates)
            if (search.keeps_limits(one, must_reach)) return one;
    }
    return drive;
}

/// The limits that a design lies on, within one per cent.
std::vector<std::string> limits_at(DesignTask const& t, theory::DriveSpace const& space,
                                   RiskDesign const& d) {
    std::vector<std::string> active;
    auto const ends = [&](char const* name, double value, theory::Range const& r, double in_unit,
                          char const* unit) {
        double const slack = near_limit * (r.high - r.low);
        if (r.high == r.low) return;
        if (value > r.high - slack)
            active.push_back(fmt::format("{} <= {:.4g}{}", name, in_unit * r.high, unit));
        if (value < r.low + slack)
            active.push_back(fmt::format("{} >= {:.4g}{}", name, in_unit * r.low, unit));
    };
    constexpr double close = 1 - near_limit;
    if (d.machine_number > close * space.max_machine_number)
        active.push_back(fmt::format("machine number <= {:.4g}", space.max_machine_number));
    if (d.throw_number > close * space.max_throw_number)
        active.push_back(fmt::format("throw number <= {:.4g}", space.max_throw_number));
    if (t.landing_speed && d.landing_speed > close * *t.landing_speed)
        active.push_back(fmt::format("landing speed <= {:.4g} m/s", *t.landing_speed));
    ends("speed of the drive", d.drive.frequency, space.frequency, 60, " 1/min");
    ends("stroke", d.drive.amplitude, space.amplitude, 2000, " mm");
    ends("vibration angle", d.drive.vibration_angle, space.vibration_angle, 1 / degree, " degrees");
    ends("inclination", d.drive.inclination, space.inclination, 1 / degree, " degrees");
    if (d.depth > close * t.depth.high)
        active.push_back(fmt::format("layer depth <= {:.4g} mm", 1e3 * t.depth.high));
    for (DesignModel const& model : t.models) {
        if (model.excess(d.drive) > -near_limit)
            active.push_back(fmt::format("the range that {} knows", model.name));
    }
    return active;
}

std::vector<std::string> warnings_at(DesignTask const& task, RiskDesign const& d) {
    std::vector<std::string> warnings;
    bool const theory_alone =
        std::ranges::all_of(task.models, [](DesignModel const& m) { return m.is_point_mass; });
    if (auto const factor = factor_of_rolling_layers(d.throw_number); factor && theory_alone) {
        warnings.push_back(fmt::format(
            "If the grains can roll, the theory alone is wrong here: at throw number {:.2f} simulated layers "
            "of spheres were conveyed {:.2g} times as fast as it says (level, tan(beta) 0.5, friction 0.23; "
            "validation/why_theory_fails and rolling_layer). {} Use --model rolling-layer beside it, "
            "and check the design with grains: --campaign FILE.",
            d.throw_number, *factor,
            *factor >= 1 ? "The mass flow is then on the safe side, but the layer is thinner than printed."
                         : "The mass flow may then not be reached."));
    }
    std::vector<std::string> depths;
    for (DesignModel const& model : task.models)
        if (!model.errors.empty() && !model.discrepancy && !model.uses_calibrated_discrepancy)
            depths.push_back(fmt::format("{:g} for {}", largest_depth(model.errors), model.name));
    if (!depths.empty() && !task.grain_diameter && !d.untested)
        warnings.push_back(
            fmt::format("The depth in grains is not known: the probability holds only if {:.3g} mm are no "
                        "more diameters than "
                        "the simulated layers had ({}). With --grain-diameter the program judges it.",
                        1e3 * d.depth, fmt::join(depths, ", ")));
    for (DesignModel const& model : task.models)
        warnings.insert(warnings.end(), model.remarks.begin(), model.remarks.end());
    return warnings;
}

/// What the point mass does at the median of the friction.
void describe_motion(DesignTask const& task, RiskDesign& d) {
    theory::PointMass const point{d.throw_number, std::tan(d.drive.vibration_angle),
                                  std::tan(d.drive.inclination), task.friction.median};
    theory::ConveyorMotion const answer = theory::solve(theory::Conveyor{.point = point});
    d.efficiency = answer.motion.velocity_efficiency;
    d.mode = answer.motion.mode;
    d.power_per_mass = theory::impact_and_power(answer, {d.drive.amplitude, task.space.gravity}).mean_power;
}

/// The best machine that reaches the mass flow, rounded; nothing when none is better than the fastest one.
/// The search knows the sure speed by few frictions: where many say that what it found does not reach the
/// mass flow, it expects less and begins again.
std::optional<theory::Drive> best_that_reaches(RiskSearch& search, theory::Drive const& fastest) {
    Objective const objective = search.task().objective;
    search.trust_at(fastest);
    for (int i = 0; i < corrections; ++i) {
        auto const found = best_at_every_friction(search, objective, true);
        if (!found) return {};
        theory::Drive const drive = rounded(search, *found, objective, true);
        if (search.sure_speed(drive) >= search.needed()) {
            if (search.merit(drive, objective) > search.merit(fastest, objective)) return drive;
            return {};
        }
        search.trust_at(*found);
    }
    return {};
}

/// What a model says of a machine with a layer of a depth, in m.
ModelForecast forecast(RiskSearch const& search, DesignModel const& model, theory::Drive const& drive,
                       double depth) {
    DesignTask const& task = search.task();
    std::optional<double> in_grains;
    if (task.grain_diameter) in_grains = depth / *task.grain_diameter;
    SpeedDistribution const speeds = search.speeds(drive, model, in_grains);
    double const flow = task.bulk_density * task.width * depth, median = speeds.exceeded_with(0.5);
    ModelForecast f{model.name,
                    median,
                    speeds.exceeded_with(task.confidence),
                    flow * speeds.exceeded_with(0.975),
                    flow * speeds.exceeded_with(0.025),
                    flow * median,
                    speeds.probability_above(task.mass_flow / flow * (1 - 1e-9)),
                    {},
                    model.at(drive, task.friction.median),
                    model.untested(drive, task.friction.median, in_grains)};
    f.flow_sd = flow * speeds.sd();
    f.budget = budget_of(search, model, drive, depth);
    for (double const share : quantile_shares())
        f.flow_quantiles.push_back(flow * speeds.exceeded_with(1 - share));
    return f;
}

/// @param given_depth  m, of a layer that is there; nothing: as deep as the mass flow needs
RiskDesign described(DesignTask const& task, RiskSearch& search, theory::Drive const& drive,
                     std::optional<double> given_depth = {}) {
    RiskDesign d{};
    d.drive = drive;
    d.throw_number = drive.throw_number(task.space.gravity);
    d.machine_number = drive.machine_number(task.space.gravity);
    d.sure_speed = search.sure_speed(drive);
    d.feasible = d.sure_speed >= search.needed();
    double const per_depth = task.bulk_density * task.width;  // kg/s for each m of depth and m/s of speed
    double const depth = d.sure_speed > 0 ? task.mass_flow / (per_depth * d.sure_speed) : task.depth.high;
    d.depth = given_depth.value_or(
        std::clamp(std::ceil(depth / depth_step - 1e-9) * depth_step, task.depth.low, task.depth.high));
    if (given_depth) d.feasible = depth <= *given_depth * (1 + 1e-9);
    for (DesignModel const& model : task.models) {
        d.forecasts.push_back(forecast(search, model, drive, d.depth));
        if (!d.untested) d.untested = d.forecasts.back().untested;
    }
    for (DesignModel const& model : task.beside)
        if (model.is_point_mass || model.excess(drive) <= 0)
            d.beside.push_back(forecast(search, model.of_layer(d.depth), drive, d.depth));
    d.feasible = d.feasible && !d.untested;
    if (!d.feasible && !d.untested && d.sure_speed > 0)
        d.width_needed = task.mass_flow / (task.bulk_density * task.depth.high * d.sure_speed);
    d.probability = 1;
    for (ModelForecast const& f : d.forecasts) d.probability = std::min(d.probability, f.probability);
    d.landing_speed = search.worst_landing(drive).speed;
    describe_motion(task, d);
    d.active_limits = limits_at(task, search.space(), d);
    d.warnings = warnings_at(task, d);
    return d;
}

/// The same task with models that know how deep the layer is, in m.
DesignTask at_depth(DesignTask task, double depth) {
    for (DesignModel& model : task.models) model = model.of_layer(depth);
    return task;
}

/// The best machine whose speed of the drive may be anything within its range, by models as they are.
RiskDesign design_by_these(DesignTask const& task) {
    theory::DriveSpace const space = allowed_space(task);
    // The search begins at the least vigorous drive.
    theory::Drive const weakest{space.frequency.low, space.amplitude.low, space.vibration_angle.low,
                                (space.inclination.low + space.inclination.high) / 2};
    if (theory::excess(space, weakest) > 0) throw std::invalid_argument(why_no_machine(task));
    RiskSearch search(task, space);
    auto const fastest = best_at_every_friction(search, Objective::fastest, false);
    if (!fastest) throw std::invalid_argument(why_no_machine(task));
    bool const reaches = search.sure_speed(*fastest) >= search.needed();
    if (reaches && task.objective != Objective::fastest) {
        if (auto const better = best_that_reaches(search, *fastest)) return described(task, search, *better);
    }
    return described(task, search,
                     rounded(search, *fastest, reaches ? task.objective : Objective::fastest, reaches));
}

/// How good a machine is, to be compared with one for another speed of the drive: first whether it reaches
/// the mass flow, then the objective; without the mass flow, the sure speed.
std::pair<bool, double> worth(DesignTask const& task, RiskDesign const& d) {
    if (!d.feasible) return {false, d.sure_speed};
    switch (task.objective) {
        case Objective::fastest:
            break;
        case Objective::gentlest_landing:
            return {true, -d.landing_speed};
        case Objective::least_machine_number:
            return {true, -d.machine_number};
        case Objective::least_power:
            return {true, -d.power_per_mass / d.sure_speed};
    }
    return {true, d.sure_speed};
}

/// The best machine whose speed of the drive may be anything within its range, by models that know the depth
/// of the layer which carries the mass flow.
RiskDesign design_at_any_speed(DesignTask const& task) {
    if (std::ranges::none_of(task.models, [](DesignModel const& m) { return bool(m.with_depth); }))
        return design_by_these(task);
    RiskDesign before{}, found{};
    found.depth = std::sqrt(task.depth.low * task.depth.high);
    for (int i = 0; i < most_depths; ++i) {
        before = std::exchange(found, design_by_these(at_depth(task, found.depth)));
        if (std::abs(found.depth - before.depth) <= same_depth * before.depth) return found;
    }
    // Two machines with other depths in turn: the better one, each judged with the layer of either.
    std::optional<RiskDesign> best;
    for (theory::Drive const& drive : {before.drive, found.drive})
        for (double const depth : {before.depth, found.depth})
            if (auto one = judge_machine(task, drive, depth); !best || worth(task, one) > worth(task, *best))
                best = std::move(one);
    return *best;
}

/// The task for each speed and stroke that can be had.
std::vector<DesignTask> choices_of(DesignTask const& task) {
    std::vector<DesignTask> all{task};
    all.front().frequencies.clear();
    all.front().amplitudes.clear();
    auto const choose = [&](std::vector<double> const& values, theory::Range theory::DriveSpace::*range) {
        if (values.empty()) return;
        std::vector<DesignTask> chosen;
        for (DesignTask const& one : all) {
            for (double const value : values) {
                chosen.push_back(one);
                chosen.back().space.*range = {value, value};
            }
        }
        all = chosen;
    };
    choose(task.frequencies, &theory::DriveSpace::frequency);
    choose(task.amplitudes, &theory::DriveSpace::amplitude);
    return all;
}

RiskDesign best_of_choices(DesignTask const& task) {
    std::optional<RiskDesign> best;
    std::vector<SpeedTried> tried;
    std::vector<std::pair<std::pair<bool, double>, std::size_t>> order;
    for (DesignTask const& one : choices_of(task)) {
        try {
            RiskDesign const design = design_at_any_speed(one);
            tried.push_back({.frequency = design.drive.frequency,
                             .feasible = design.feasible,
                             .amplitude = design.drive.amplitude,
                             .sure_speed = design.sure_speed,
                             .depth = design.depth,
                             .probability = design.probability,
                             .machine_number = design.machine_number,
                             .landing_speed = design.landing_speed,
                             .untested = design.untested,
                             .vibration_angle = design.drive.vibration_angle,
                             .inclination = design.drive.inclination});
            order.emplace_back(worth(task, design), tried.size() - 1);
            if (!best || worth(task, design) > worth(task, *best)) best = design;
        } catch (std::invalid_argument const& error) {
            auto const given = [](theory::Range const& r) { return r.low == r.high ? r.low : 0; };
            tried.push_back({.frequency = given(one.space.frequency),
                             .amplitude = given(one.space.amplitude),
                             .why_none = error.what()});
        }
    }
    if (!best) {
        std::string text;
        for (SpeedTried const& one : tried) {
            text += text.empty() ? "" : "; ";
            if (!task.frequencies.empty()) text += fmt::format("at {:.4g} 1/min ", 60 * one.frequency);
            if (!task.amplitudes.empty())
                text += fmt::format("with a stroke of {:.4g} mm ", 2e3 * one.amplitude);
            text += *one.why_none;
        }
        throw std::invalid_argument(text);
    }
    // Of equals, the first speed that was asked for is the better one, as above.
    std::ranges::stable_sort(order, [](auto const& a, auto const& b) { return a.first > b.first; });
    for (std::size_t i = 0; i < order.size(); ++i) tried[order[i].second].rank = static_cast<int>(i) + 1;
    best->speeds_tried = tried;
    return *best;
}

}  // namespace

std::vector<double> quantile_shares() {
    std::vector<double> shares;
    for (int i = 1; i < 40; ++i) shares.push_back(i / 40.0);
    return shares;
}

RiskDesign design_with_risk(DesignTask const& task) {
    check(task);
    bool const is_free = task.frequencies.empty() && task.amplitudes.empty();
    return is_free ? design_at_any_speed(task) : best_of_choices(task);
}

RiskDesign judge_machine(DesignTask const& task, theory::Drive const& drive, double depth) {
    check(task);
    DesignTask one = at_depth(task, depth);
    if (!one.frequencies.empty()) one.space.frequency = {drive.frequency, drive.frequency};
    if (!one.amplitudes.empty()) one.space.amplitude = {drive.amplitude, drive.amplitude};
    RiskSearch search(one, allowed_space(one));
    return described(one, search, drive, depth);
}

}  // namespace vibrotrough::learn
