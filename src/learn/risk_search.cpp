#include "learn/risk_search.hpp"

#include "learn/uncertain.hpp"
#include "theory/quantities.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>

namespace vibrotrough::learn {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int landings_looked_at = 65;
/// Drives looked at per quantity that may be chosen; fewer with a model that is slow.
constexpr int global_evaluations = 2000, local_evaluations = 500;
constexpr int slow_global_evaluations = 700, slow_local_evaluations = 300;

double normal_share_above(double z) {
    return 0.5 * std::erfc(z / std::sqrt(2.0));
}

/// Impact speed and power of the plastic point mass; nothing when it runs away.
std::optional<theory::ImpactAndPower> quantities_of(theory::Drive const& d, double friction) {
    theory::PointMass const point{std::clamp(d.throw_number(), 1e-6, theory::largest_throw_number),
                                  std::tan(d.vibration_angle), std::tan(d.inclination), friction};
    theory::ConveyorMotion const motion = theory::solve(theory::Conveyor{.point = point});
    if (!motion.motion.converged) return {};
    return theory::impact_and_power(motion, {d.amplitude});
}

/// m/s, standard deviation of a model's speed when one number of a drive is not exact; beside the end of what
/// the model knows, from the slope on the other side.
double spread_by(DesignModel const& model, theory::Drive const& drive, double theory::Drive::*number,
                 double sd, double friction) {
    if (sd <= 0) return 0;
    double known = 0, sum = 0, squares = 0;
    std::vector<double> places, speeds;
    for (UncertainNode const& node : nodes_of({drive.*number, sd})) {
        theory::Drive other = drive;
        other.*number = std::max(1e-6, node.value);
        auto const value = model.at(other, friction);
        if (!value) continue;
        double const speed = value->efficiency * other.trough_speed();
        known += node.share;
        sum += node.share * speed;
        squares += node.share * speed * speed;
        places.push_back(other.*number);
        speeds.push_back(speed);
    }
    if (places.size() == 2) return sd * std::abs((speeds[1] - speeds[0]) / (places[1] - places[0]));
    return known > 0 ? std::sqrt(std::max(0.0, squares / known - sum * sum / (known * known))) : 0;
}

SettingSpread spread_of(DesignTask const& task, DesignModel const& model, theory::Drive const& drive) {
    double const mu = task.friction.median;
    return {spread_by(model, drive, &theory::Drive::amplitude, task.errors.amplitude, mu),
            spread_by(model, drive, &theory::Drive::vibration_angle, task.errors.vibration_angle, mu),
            task.errors.bulk_density / task.bulk_density};
}

/// What a model says of a drive, by parts of the friction.
SpeedDistribution speeds_by(DesignTask const& task, DesignModel const& model, theory::Drive const& drive,
                            std::optional<double> depth, std::vector<FrictionPart> const& parts) {
    double const usually_missed = model.missed(drive, depth), trough = drive.trough_speed();
    SettingSpread const set = spread_of(task, model, drive);
    SpeedDistribution d;
    for (FrictionPart const& part : parts) {
        auto const value = model.at(drive, part.friction);
        // A material that runs away has no speed that could be used.
        double const mean = value ? value->efficiency * trough : -1e3, known = value ? value->sd() : 0;
        auto const add = [&](double share, double missed) {
            d.shares.push_back(share);
            d.means.push_back(mean);
            double const settings =
                std::hypot(set.amplitude, set.vibration_angle, set.bulk_density * std::abs(mean));
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

RiskSearch::RiskSearch(DesignTask const& task, theory::DriveSpace space)
    : task_(task),
      space_(space),
      few_(task.friction.parts(few_parts(task.confidence))),
      many_(task.friction.parts(many_parts(task.confidence))),
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

double RiskSearch::needed() const {
    return task_.mass_flow / (task_.bulk_density * task_.width * task_.depth.high);
}

SpeedDistribution RiskSearch::speeds(theory::Drive const& drive, DesignModel const& model,
                                     std::optional<double> depth) const {
    return speeds_by(task_, model, drive, depth, many_);
}

SettingSpread RiskSearch::spread_of_settings(theory::Drive const& drive, DesignModel const& model) const {
    return spread_of(task_, model, drive);
}

double RiskSearch::sure_speed(theory::Drive const& drive, std::vector<FrictionPart> const& parts) const {
    double least = infinity;
    for (DesignModel const& model : task_.models)
        least = std::min(least, speeds_by(task_, model, drive, {}, parts).exceeded_with(task_.confidence));
    return least;
}

double RiskSearch::sure_speed(theory::Drive const& drive) const {
    return sure_speed(drive, many_);
}

double RiskSearch::expected_sure_speed(theory::Drive const& drive) const {
    return correction_ * sure_speed(drive, few_);
}

void RiskSearch::trust_at(theory::Drive const& drive) {
    double const few = sure_speed(drive, few_), many = sure_speed(drive, many_);
    if (few > 0 && many > 0) correction_ = many / few;
}

double RiskSearch::merit(theory::Drive const& drive, Objective objective) const {
    switch (objective) {
        case Objective::fastest:
            return expected_sure_speed(drive);
        case Objective::gentlest_landing: {
            double hardest = 0;
            for (double const friction : landing_frictions_)
                hardest = std::max(hardest, landing_speed(drive, friction));
            return -hardest;
        }
        case Objective::least_machine_number:
            return -drive.machine_number(space_.gravity);
        case Objective::least_power: {
            auto const quantities = quantities_of(drive, task_.friction.median);
            if (!quantities) return -infinity;
            // Of the layer that carries the mass flow.
            return -quantities->mean_power / std::max(1e-9, expected_sure_speed(drive));
        }
    }
    return 0;
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

void RiskSearch::keep_landing_at(double friction, double speed) {
    double const close = 1e-3 * (task_.friction.high - task_.friction.low);
    bool const known = std::ranges::any_of(landing_frictions_,
                                           [&](double one) { return std::abs(one - friction) <= close; });
    if (known) aim_ *= std::min(0.999, *task_.landing_speed / speed);
    landing_frictions_.push_back(friction);
}

bool RiskSearch::keeps_limits(theory::Drive const& drive, bool must_reach) const {
    if (excess(space_, drive) > 0) return false;
    for (DesignModel const& model : task_.models)
        if (model.excess(drive) > 0) return false;
    if (task_.landing_speed && worst_landing(drive).speed > *task_.landing_speed) return false;
    return !must_reach || sure_speed(drive) >= needed();
}

std::optional<theory::Drive> RiskSearch::best(Objective objective, bool must_reach) const {
    std::vector<theory::DriveFunction> excesses;
    for (DesignModel const& model : task_.models)
        if (!model.is_point_mass) excesses.push_back(model.excess);
    if (task_.landing_speed) {
        excesses.emplace_back([this](theory::Drive const& drive) {
            double hardest = 0;
            for (double const friction : landing_frictions_)
                hardest = std::max(hardest, landing_speed(drive, friction));
            return hardest / (aim_ * *task_.landing_speed) - 1;
        });
    }
    if (must_reach)
        excesses.emplace_back(
            [this](theory::Drive const& drive) { return 1 - expected_sure_speed(drive) / needed(); });
    int free = 0;
    for (theory::Range const& range :
         {space_.frequency, space_.amplitude, space_.vibration_angle, space_.inclination})
        free += range.low < range.high ? 1 : 0;
    free = std::max(1, free);
    bool const is_slow = std::ranges::any_of(task_.models, &DesignModel::is_slow);
    theory::DriveSearchSettings const settings{
        free * (is_slow ? slow_global_evaluations : global_evaluations),
        free * (is_slow ? slow_local_evaluations : local_evaluations)};
    return theory::best_drive(
        space_, [&](theory::Drive const& drive) { return merit(drive, objective); }, excesses, settings);
}

}  // namespace vibrotrough::learn
