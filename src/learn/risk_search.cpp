#include "learn/risk_search.hpp"

#include "learn/machine_keys.hpp"
#include "learn/uncertain.hpp"
#include "learn/way_out.hpp"
#include "theory/quantities.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::learn {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int landings_looked_at = 65;
constexpr int exchanges = 8;
constexpr int corrections = 3;            // of what the search expects of the sure speed
constexpr int parts_of_slow_models = 40;  // whose own error smooths the distribution
constexpr std::size_t polished_layers = 2;
constexpr double depth_step = 1e-4;  // m, to which the depth is rounded up
constexpr double no_speed = -1e3;    // m/s, of a material that runs away, which is of no use

double normal_share_above(double z) {
    return 0.5 * std::erfc(z / std::sqrt(2.0));
}

/// Impact speed and power of the plastic point mass; nothing when it runs away.
std::optional<theory::ImpactAndPower> quantities_of(theory::Drive const& d, double friction) {
    theory::ConveyorMotion const motion = theory::solve(theory::Conveyor{.point = point_of(d, friction)});
    if (!motion.motion.converged) return {};
    return theory::impact_and_power(motion, {d.amplitude});
}

/// m/s, standard deviation of a model's speed when one number of a drive is not exact; beside the end of what
/// the model knows, from the slope on the other side.
double spread_by(DesignModel const& model, DesignLayer const& layer, double theory::Drive::*number, double sd,
                 double friction) {
    if (sd <= 0) return 0;
    double known = 0, sum = 0, squares = 0;
    std::vector<double> places, speeds;
    for (UncertainNode const& node : nodes_of({layer.drive.*number, sd})) {
        DesignLayer other = layer;
        other.drive.*number = std::max(1e-6, node.value);
        auto const efficiency = model.speeds->near_efficiency(other, friction);
        if (!efficiency) continue;
        double const speed = *efficiency * other.drive.trough_speed();
        known += node.share;
        sum += node.share * speed;
        squares += node.share * speed * speed;
        places.push_back(other.drive.*number);
        speeds.push_back(speed);
    }
    if (places.size() == 2) return sd * std::abs((speeds[1] - speeds[0]) / (places[1] - places[0]));
    return known > 0 ? std::sqrt(std::max(0.0, squares / known - sum * sum / (known * known))) : 0;
}

SettingSpread spread_of(DesignTask const& task, DesignModel const& model, DesignLayer const& layer) {
    double const mu = task.friction.median;
    return {spread_by(model, layer, &theory::Drive::amplitude, task.errors.amplitude, mu),
            spread_by(model, layer, &theory::Drive::vibration_angle, task.errors.vibration_angle, mu),
            task.errors.bulk_density / task.bulk_density};
}

/// What a model says of a layer, by parts of the friction.
SpeedDistribution speeds_by(DesignTask const& task, DesignModel const& model, DesignLayer const& layer,
                            std::vector<FrictionPart> const& parts, Precision precision) {
    double const usually_missed = model.missed(layer.drive, task.in_grains(layer.depth), task.confidence);
    double const trough = layer.drive.trough_speed();
    SpeedDistribution d;
    d.settings = spread_of(task, model, layer);
    for (FrictionPart const& part : parts) {
        auto const value = model.at(layer, part.friction, precision);
        double const mean = value ? value->efficiency * trough : no_speed, known = value ? value->sd() : 0;
        auto const add = [&](double share, double missed) {
            d.shares.push_back(share);
            d.means.push_back(mean);
            double const settings = std::hypot(d.settings.amplitude, d.settings.vibration_angle,
                                               d.settings.bulk_density * std::abs(mean));
            d.sds.push_back(std::hypot(trough * std::hypot(known, missed), value ? settings : 0));
        };
        if (!model.uses_calibrated_discrepancy || part.discrepancies.empty()) {
            add(part.share, usually_missed);
            continue;
        }
        for (double const missed : part.discrepancies)
            add(part.share / static_cast<double>(part.discrepancies.size()), missed);
    }
    return d;
}

bool is_any_slow(std::vector<DesignModel> const& models) {
    return std::ranges::any_of(models, &DesignModel::is_slow);
}

std::vector<FrictionPart> parts_to_judge_by(DesignTask const& task) {
    bool const is_slow = is_any_slow(task.models) || is_any_slow(task.beside);
    return task.friction.parts(is_slow ? many_parts(task.confidence, parts_of_slow_models)
                                       : many_parts(task.confidence));
}

}  // namespace

double landing_speed(theory::Drive const& drive, double friction) {
    if (drive.throw_number() <= 1) return 0;
    auto const quantities = quantities_of(drive, friction);
    return quantities ? quantities->impact_speed : infinity;
}

double SpeedDistribution::probability_above(double speed) const {
    double sum = 0;
    for (std::size_t i = 0; i < means.size(); ++i)
        sum += shares[i] *
               (sds[i] > 0 ? normal_share_above((speed - means[i]) / sds[i]) : (means[i] >= speed ? 1 : 0));
    return sum;
}

double SpeedDistribution::exceeded_with(double probability) const {
    double low = infinity, high = -infinity;
    for (std::size_t i = 0; i < means.size(); ++i) {
        low = std::min(low, means[i] - 6 * sds[i]);
        high = std::max(high, means[i] + 6 * sds[i]);
    }
    high += 1e-9 * std::max(1.0, std::abs(high));
    auto const surplus = [&](double speed) { return probability_above(speed) - probability * (1 - 1e-12); };
    double const at_low = surplus(low), at_high = surplus(high);
    if (at_low <= 0) return low;
    if (at_high >= 0) return high;
    std::uintmax_t most = 60;
    return boost::math::tools::toms748_solve(surplus, low, high, at_low, at_high,
                                             boost::math::tools::eps_tolerance<double>(36), most)
        .first;
}

double SpeedDistribution::sd_of_means() const {
    double mean = 0, squares = 0;
    for (std::size_t i = 0; i < means.size(); ++i) mean += shares[i] * means[i];
    for (std::size_t i = 0; i < means.size(); ++i)
        squares += shares[i] * (means[i] - mean) * (means[i] - mean);
    return std::sqrt(squares);
}

double SpeedDistribution::sd() const {
    double within = 0;
    for (std::size_t i = 0; i < sds.size(); ++i) within += shares[i] * sds[i] * sds[i];
    return std::hypot(sd_of_means(), std::sqrt(within));
}

bool SpeedDistribution::may_run_away() const {
    return std::ranges::find(means, no_speed) != means.end();
}

SpeedDistribution SpeedDistribution::of_speed_alone() const {
    SpeedDistribution alone = *this;
    for (std::size_t i = 0; i < sds.size(); ++i) {
        double const by_density = means[i] == no_speed ? 0 : settings.bulk_density * means[i];
        alone.sds[i] = std::sqrt(std::max(0.0, sds[i] * sds[i] - by_density * by_density));
    }
    return alone;
}

RiskSearch::RiskSearch(DesignTask const& task, Layers layers)
    : task_(task),
      layers_(layers),
      allowed_(allowed_layers(task)),
      space_(allowed_.drives, allowed_.depth),
      few_(task.friction.parts(few_parts(task.confidence))),
      many_(parts_to_judge_by(task)),
      landing_frictions_{task.friction.low} {
    if (task.friction.high > task.friction.low) landing_frictions_.push_back(task.friction.high);
    // The search takes all draws of a part together.
    for (FrictionPart& part : few_) {
        if (part.discrepancies.empty()) continue;
        double squares = 0;
        for (double const one : part.discrepancies) squares += one * one;
        part.discrepancies = {std::sqrt(squares / static_cast<double>(part.discrepancies.size()))};
    }
}

double RiskSearch::per_depth_and_speed() const {
    return task_.bulk_density * task_.width;
}

SpeedDistribution RiskSearch::speeds(DesignLayer const& layer, DesignModel const& model) const {
    return speeds_by(task_, model, layer, many_, Precision::exact);
}

double RiskSearch::sure_speed(DesignLayer const& layer) const {
    double least = infinity;
    for (DesignModel const& model : task_.models)
        least = std::min(least, speeds(layer, model).exceeded_with(task_.confidence));
    return least;
}

double RiskSearch::sure_flow(DesignLayer const& layer) const {
    return per_depth_and_speed() * layer.depth * sure_speed(layer);
}

/// m/s, the sure speed as the search expects it, by the few parts of the friction.
double RiskSearch::expected_speed(DesignLayer const& layer, Precision precision) const {
    auto const& [frequency, amplitude, angle, inclination] = layer.drive;
    auto& known = known_speeds_[precision == Precision::near ? 0 : 1];
    auto const [found, is_new] =
        known.try_emplace({frequency, amplitude, angle, inclination, layer.depth}, infinity);
    if (is_new)
        for (DesignModel const& model : task_.models)
            found->second =
                std::min(found->second,
                         speeds_by(task_, model, layer, few_, precision).exceeded_with(task_.confidence));
    return correction_ * found->second;
}

bool RiskSearch::is_looked_at(DesignLayer const& layer) const {
    return layers_ == Layers::all || !untested(task_, layer);
}

void RiskSearch::add_limits(LayerGoal& goal) const {
    for (DesignModel const& model : task_.models)
        if (!model.is_point_mass)
            goal.excesses.emplace_back([&](DesignLayer const& layer) { return model.excess(layer.drive); });
    if (task_.landing_speed)
        goal.excesses.emplace_back([this](DesignLayer const& layer) {
            double hardest = 0;
            for (double const friction : landing_frictions_)
                hardest = std::max(hardest, landing_speed(layer.drive, friction));
            return hardest / (aim_ * *task_.landing_speed) - 1;
        });
}

std::optional<FoundLayer> RiskSearch::strongest() {
    auto const carried = [this](Precision precision) {
        LayerGoal goal;
        goal.merit = [this, precision](DesignLayer const& layer) {
            return is_looked_at(layer) ? layer.depth * expected_speed(layer, precision) : -infinity;
        };
        add_limits(goal);
        return goal;
    };
    return best(carried, {});
}

/// What is made as large as possible among layers that carry the mass flow.
double RiskSearch::objective_at(DesignLayer const& layer, Precision precision) const {
    switch (task_.objective) {
        case Objective::fastest: {
            // Where the mass flow is just carried, the thinnest layer is the fastest.
            double const just = task_.mass_flow / (per_depth_and_speed() * layer.depth);
            return layer.depth > allowed_.depth.low ? just : std::max(just, expected_speed(layer, precision));
        }
        case Objective::gentlest_landing: {
            double hardest = 0;
            for (double const friction : landing_frictions_)
                hardest = std::max(hardest, landing_speed(layer.drive, friction));
            return -hardest;
        }
        case Objective::least_machine_number:
            return -layer.drive.machine_number(allowed_.drives.gravity);
        case Objective::least_power: {
            auto const quantities = quantities_of(layer.drive, task_.friction.median);
            if (!quantities) return -infinity;
            // Of the layer that carries the mass flow.
            return -quantities->mean_power / std::max(1e-9, expected_speed(layer, precision));
        }
    }
    return 0;
}

double RiskSearch::merit(DesignLayer const& layer) const {
    if (task_.objective == Objective::fastest) return expected_speed(layer, Precision::exact);
    return objective_at(layer, Precision::exact);
}

std::optional<FoundLayer> RiskSearch::best_that_carries(FoundLayer const& strongest) {
    auto const goal_of = [this](Precision precision) {
        LayerGoal goal;
        goal.merit = [this, precision](DesignLayer const& layer) {
            return is_looked_at(layer) ? objective_at(layer, precision) : -infinity;
        };
        goal.excesses.emplace_back([this, precision](DesignLayer const& layer) {
            double const flow = per_depth_and_speed() * layer.depth * expected_speed(layer, precision);
            return 1 - flow / task_.mass_flow;
        });
        add_limits(goal);
        return goal;
    };
    // The search knows the sure speed by few frictions. Where many say that what it found does not carry the
    // mass flow, it expects less and begins again.
    FoundLayer trusted = strongest;
    for (int i = 0; i < corrections; ++i) {
        double const expected = expected_speed(trusted.layer, Precision::exact);
        double const known = sure_speed(trusted.layer);
        if (known > 0 && expected > 0) correction_ *= known / expected;
        auto found = best(goal_of, {strongest.point});
        if (!found) break;
        if (sure_flow(found->layer) >= task_.mass_flow) return found;
        trusted = *found;
    }
    return {};
}

std::optional<double> RiskSearch::carrying_depth(theory::Drive const& drive, double known) const {
    auto const surplus = [&](double depth) { return sure_flow({drive, depth}) / task_.mass_flow - 1; };
    auto const carries = [&](double depth) { return surplus(depth) >= -1e-9; };
    double const at_low = surplus(allowed_.depth.low);
    if (at_low >= 0) return allowed_.depth.low;
    double const enough = known > allowed_.depth.low && carries(known) ? known : allowed_.depth.high;
    double const at_enough = surplus(enough);
    if (at_enough < -1e-9) return {};
    if (at_enough <= 0) return enough;
    std::uintmax_t most = 30;
    double const exact =
        boost::math::tools::toms748_solve(surplus, allowed_.depth.low, enough, at_low, at_enough,
                                          boost::math::tools::eps_tolerance<double>(24), most)
            .second;
    double const rounded = std::ceil(exact / depth_step - 1e-6) * depth_step;
    if (rounded <= allowed_.depth.high && carries(rounded)) return rounded;
    return enough;
}

std::optional<FoundLayer> RiskSearch::best_at_these_frictions(
    GoalOf const& goal, std::vector<std::vector<double>> const& starts) const {
    auto const near = best_layers(space_, goal(Precision::near), starts);
    if (near.empty()) return {};
    if (!is_any_slow(task_.models)) return near.front();
    std::optional<FoundLayer> best;
    for (FoundLayer const& one : near) {
        auto const exact = polished(space_, goal(Precision::exact), one.point);
        if (exact && (!best || exact->merit > best->merit)) best = exact;
        if (&one == &near[std::min(polished_layers, near.size()) - 1] && best) break;
    }
    return best;
}

/// The exchange method: the limit of the landing speed is kept at a few frictions, and the worst one joins
/// until none is above it.
std::optional<FoundLayer> RiskSearch::best(GoalOf const& goal,
                                           std::vector<std::vector<double>> const& starts) {
    for (int i = 0; i < exchanges; ++i) {
        auto const found = best_at_these_frictions(goal, starts);
        if (!found || !task_.landing_speed) return found;
        Landing const worst = worst_landing(found->layer.drive);
        if (worst.speed <= *task_.landing_speed) return found;
        keep_landing_at(worst);
    }
    return {};
}

RiskSearch::Landing RiskSearch::worst_landing(theory::Drive const& drive) const {
    double const low = task_.friction.low, high = task_.friction.high;
    if (!(low < high)) return {low, landing_speed(drive, low)};
    double const step = (high - low) / (landings_looked_at - 1);
    Landing worst{low, -1};
    for (int i = 0; i < landings_looked_at; ++i) {
        double const friction = i + 1 == landings_looked_at ? high : low + step * i;
        double const speed = landing_speed(drive, friction);
        if (speed > worst.speed) worst = {friction, speed};
    }
    auto const [friction, minus] = boost::math::tools::brent_find_minima(
        [&](double mu) { return -landing_speed(drive, mu); }, std::max(low, worst.friction - step),
        std::min(high, worst.friction + step), 24);
    if (-minus > worst.speed) worst = {friction, -minus};
    return worst;
}

void RiskSearch::keep_landing_at(Landing const& landing) {
    double const close = 1e-3 * (task_.friction.high - task_.friction.low);
    bool const known = std::ranges::any_of(
        landing_frictions_, [&](double one) { return std::abs(one - landing.friction) <= close; });
    if (known) aim_ *= std::min(0.999, *task_.landing_speed / landing.speed);
    landing_frictions_.push_back(landing.friction);
}

bool RiskSearch::keeps_limits(theory::Drive const& drive) const {
    if (excess(allowed_.drives, drive) > 0) return false;
    for (DesignModel const& model : task_.models)
        if (model.excess(drive) > 0) return false;
    return !task_.landing_speed || worst_landing(drive).speed <= *task_.landing_speed;
}

}  // namespace vibrotrough::learn
