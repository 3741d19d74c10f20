#include "measure/stage_means.hpp"

#include "measure/mass_flow.hpp"
#include "measure/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

namespace vibrotrough::measure {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
constexpr double share_of_change = 0.95;

using Series = std::vector<double>;

double mean_between(Series const& values, int first, int count) {
    if (count < 1) return not_known;
    return as_array(
               std::span(values).subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count)))
        .mean();
}

int end_of(StageCycles const& stage) {
    return stage.first + stage.cycles;
}

double speed_at_end(StageCycles const& stage, Series const& velocity) {
    int const count = cycles_at_speed(stage);
    return mean_between(velocity, end_of(stage) - count, count);
}

double change_at_end(StageCycles const& stage, Series const& velocity) {
    int const count = cycles_at_speed(stage), half = count / 2;
    return mean_between(velocity, end_of(stage) - half, half) -
           mean_between(velocity, end_of(stage) - count, half);
}

double distance_in(StageCycles const& stage, Series const& velocity, Series const& durations) {
    auto const from = [&](Series const& all) { return all.begin() + stage.first; };
    return std::inner_product(from(velocity), from(velocity) + stage.cycles, from(durations), 0.0);
}

/// The mean over the packings; without one of them when `left_out` is its index.
Series mean_of(std::vector<Series> const& packings, std::size_t left_out) {
    Series mean(packings.front().size(), 0);
    double count = 0;
    for (std::size_t i = 0; i < packings.size(); ++i) {
        if (i == left_out) continue;
        ++count;
        std::ranges::transform(mean, packings[i], mean.begin(), std::plus());
    }
    for (double& value : mean) value /= count;
    return mean;
}

template <typename Function>
EnsembleNumber of_packings(std::vector<Series> const& packings, Function const& number) {
    EnsembleNumber result;
    for (Series const& packing : packings) result.values.push_back(number(packing));
    return result;
}

/// The pseudo-values of a number of the mean over the packings.
template <typename Function>
EnsembleNumber jackknife(std::vector<Series> const& packings, Function const& number) {
    double const whole = number(mean_of(packings, packings.size()));
    auto const count = static_cast<double>(packings.size());
    if (packings.size() == 1) return {{whole}};
    EnsembleNumber result;
    for (std::size_t i = 0; i < packings.size(); ++i)
        result.values.push_back(count * whole - (count - 1) * number(mean_of(packings, i)));
    return result;
}

bool differ(EnsembleNumber const& one, EnsembleNumber const& other, double confidence) {
    auto const width = [&](EnsembleNumber const& number) {
        double const half = number.half_width(confidence);
        return std::isfinite(half) ? half : 0;
    };
    return std::abs(one.mean() - other.mean()) > width(one) + width(other);
}

}  // namespace

double EnsembleNumber::mean() const {
    return values.empty() ? not_known : as_array(values).mean();
}

double EnsembleNumber::half_width(double confidence) const {
    return student_half_width(values, confidence).value_or(not_known);
}

int cycles_at_speed(StageCycles const& stage) {
    int const behind = stage.cycles - stage.ramp;
    return behind == 0 ? 0 : std::max(1, behind / 2);
}

double time_to_speed(StageCycles const& stage, Series const& velocity, Series const& durations,
                     double before) {
    double const end = speed_at_end(stage, velocity);
    double time = 0, last_time = 0, last_share = 0;
    for (int cycle = stage.first; cycle < end_of(stage); ++cycle) {
        auto const i = static_cast<std::size_t>(cycle);
        double const middle = time + durations[i] / 2;
        double const share = (velocity[i] - before) / (end - before);
        if (share >= share_of_change) {
            double const part = (share_of_change - last_share) / (share - last_share);
            return last_time + part * (middle - last_time);
        }
        time += durations[i];
        last_time = middle;
        last_share = share;
    }
    return not_known;
}

std::vector<StageMeans> measure_stages(std::vector<StageCycles> const& stages,
                                       StagedVelocities const& velocities, double confidence) {
    std::vector<StageMeans> all;
    std::vector<Series> const& packings = velocities.packings;
    for (std::size_t i = 0; i < stages.size(); ++i) {
        StageCycles const& stage = stages[i];
        StageMeans means;
        means.speed = of_packings(packings, [&](Series const& v) { return speed_at_end(stage, v); });
        means.change = of_packings(packings, [&](Series const& v) { return change_at_end(stage, v); });
        means.distance = of_packings(
            packings, [&](Series const& v) { return distance_in(stage, v, velocities.durations); });
        EnsembleNumber const before = i == 0 ? EnsembleNumber{Series(packings.size(), 0)} : all.back().speed;
        means.time_to_speed = {Series(packings.size(), not_known)};
        if (differ(before, means.speed, confidence)) {
            means.time_to_speed = jackknife(packings, [&](Series const& v) {
                double const speed = i == 0 ? 0 : speed_at_end(stages[i - 1], v);
                return time_to_speed(stage, v, velocities.durations, speed);
            });
        }
        all.push_back(std::move(means));
    }
    return all;
}

}  // namespace vibrotrough::measure
