#include "learn/design_description.hpp"

#include "learn/budget.hpp"
#include "learn/machine_keys.hpp"
#include "theory/quantities.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::learn {
namespace {

constexpr double near_limit = 0.01;   // relative: a limit so close counts as active
constexpr double least_speed = -100;  // m/s: below it, the material runs away

/// The limits that a design lies on, within one per cent, and whether they are the user's.
std::vector<std::string> limits_at(RiskSearch const& search, RiskDesign const& d) {
    DesignTask const& t = search.task();
    theory::DriveSpace const &asked = t.space, &allowed = search.allowed().drives;
    std::vector<std::string> all;
    auto const add = [&](std::string const& text, bool is_of_model = false) {
        all.push_back(is_of_model ? text + " (nothing beyond is tested)" : text);
    };
    auto const add_most = [&](char const* name, double value, double most_asked, double most_allowed) {
        if (value > (1 - near_limit) * most_allowed)
            add(fmt::format("{} <= {:.4g}", name, most_allowed), most_allowed < most_asked * (1 - 1e-9));
    };
    auto const add_ends = [&](char const* name, double theory::Drive::*number,
                              theory::Range theory::DriveSpace::*range, double in_unit, char const* unit) {
        double const value = d.drive.*number;
        auto const [low, high] = allowed.*range;
        double const slack = near_limit * (high - low);
        if (high == low) return;
        if (value > high - slack)
            add(fmt::format("{} <= {:.4g}{}", name, in_unit * high, unit), high < (asked.*range).high);
        if (value < low + slack)
            add(fmt::format("{} >= {:.4g}{}", name, in_unit * low, unit), low > (asked.*range).low);
    };
    add_most("machine number", d.machine_number, asked.max_machine_number, allowed.max_machine_number);
    add_most("throw number", d.throw_number, asked.max_throw_number, allowed.max_throw_number);
    if (t.landing_speed && d.landing_speed > (1 - near_limit) * *t.landing_speed)
        add(fmt::format("landing speed <= {:.4g} m/s", *t.landing_speed));
    using theory::Drive, theory::DriveSpace;
    add_ends("speed of the drive", &Drive::frequency, &DriveSpace::frequency, 60, " 1/min");
    add_ends("stroke", &Drive::amplitude, &DriveSpace::amplitude, 2000, " mm");
    add_ends("vibration angle", &Drive::vibration_angle, &DriveSpace::vibration_angle, 1 / degree,
             " degrees");
    add_ends("inclination", &Drive::inclination, &DriveSpace::inclination, 1 / degree, " degrees");
    double const deepest = search.allowed().depth.high;
    if (d.depth > (1 - near_limit) * deepest)
        add(fmt::format("layer depth <= {:.4g} mm", 1e3 * deepest), deepest < t.depth.high);
    for (DesignModel const& model : t.models) {
        if (!model.is_point_mass && model.excess(d.drive) > -near_limit)
            add(fmt::format("the range that {} knows", model.name));
    }
    return all;
}

std::vector<std::string> warnings_at(DesignTask const& task, RiskDesign const& d) {
    std::vector<std::string> warnings;
    bool const theory_alone =
        std::ranges::all_of(task.models, [](DesignModel const& m) { return m.is_point_mass; });
    if (theory_alone && d.throw_number > 1.2 && d.throw_number < 2.3)
        warnings.emplace_back(
            "If the grains can roll, the theory alone is wrong here: between throw numbers 1.2 and 2.3 "
            "simulated layers of spheres were conveyed up to twice as fast as it says "
            "(validation/why_theory_fails). The layer is then thinner than printed. Give --grain-diameter, "
            "so "
            "that simulated layers decide.");
    for (DesignModel const& model : task.models)
        warnings.insert(warnings.end(), model.remarks.begin(), model.remarks.end());
    return warnings;
}

/// What the point mass does at the median of the friction.
void describe_motion(DesignTask const& task, RiskDesign& d) {
    theory::ConveyorMotion const answer =
        theory::solve(theory::Conveyor{.point = point_of(d.drive, task.friction.median)});
    d.efficiency = answer.motion.velocity_efficiency;
    d.mode = answer.motion.mode;
    d.power_per_mass = theory::impact_and_power(answer, {d.drive.amplitude, task.space.gravity}).mean_power;
}

/// What a model says of a layer.
ModelForecast forecast(RiskSearch const& search, DesignModel const& model, DesignLayer const& layer) {
    DesignTask const& task = search.task();
    SpeedDistribution const speeds = search.speeds(layer, model), alone = speeds.of_speed_alone();
    double const flow = task.bulk_density * task.width * layer.depth, median = speeds.exceeded_with(0.5);
    double const slowest = speeds.exceeded_with(0.975);
    ModelForecast f{model.name,
                    median,
                    alone.exceeded_with(task.confidence),
                    flow * speeds.exceeded_with(task.confidence),
                    slowest > least_speed ? flow * slowest : -HUGE_VAL,
                    flow * speeds.exceeded_with(0.025),
                    flow * median,
                    speeds.probability_above(task.mass_flow / flow * (1 - 1e-9)),
                    {},
                    model.at(layer, task.friction.median),
                    model.untested(layer.drive, task.friction.median, task.in_grains(layer.depth))};
    f.flow_sd = speeds.may_run_away() ? HUGE_VAL : flow * speeds.sd();
    if (f.efficiency) f.budget = budget_of(task, layer, model.name, *f.efficiency, speeds);
    for (double const share : quantile_shares())
        f.flow_quantiles.push_back(flow * speeds.exceeded_with(1 - share));
    return f;
}

}  // namespace

std::vector<double> quantile_shares() {
    std::vector<double> shares;
    for (int i = 1; i < 40; ++i) shares.push_back(i / 40.0);
    return shares;
}

RiskDesign described(RiskSearch const& search, DesignLayer const& layer) {
    DesignTask const& task = search.task();
    RiskDesign d{};
    d.drive = layer.drive;
    d.depth = layer.depth;
    d.throw_number = layer.drive.throw_number(task.space.gravity);
    d.machine_number = layer.drive.machine_number(task.space.gravity);
    d.sure_speed = d.sure_flow = HUGE_VAL;
    d.probability = 1;
    for (DesignModel const& model : task.models) {
        ModelForecast const& f = d.forecasts.emplace_back(forecast(search, model, layer));
        d.sure_speed = std::min(d.sure_speed, f.sure_speed);
        d.sure_flow = std::min(d.sure_flow, f.sure_flow);
        d.probability = std::min(d.probability, f.probability);
    }
    d.untested = untested(task, layer);
    d.feasible = d.sure_flow >= task.mass_flow * (1 - 1e-9) && !d.untested;
    for (DesignModel const& model : task.beside)
        if (model.is_point_mass || model.excess(layer.drive) <= 0)
            d.beside.push_back(forecast(search, model, layer));
    if (!d.feasible && !d.untested && d.sure_flow > 0)
        d.width_needed = task.width * task.mass_flow / d.sure_flow;
    d.landing_speed = search.worst_landing(layer.drive).speed;
    describe_motion(task, d);
    d.active_limits = limits_at(search, d);
    d.warnings = warnings_at(task, d);
    return d;
}

}  // namespace vibrotrough::learn
