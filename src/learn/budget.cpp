#include "learn/budget.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::learn {
namespace {

/// A source that every part of the friction has: standard deviations in m/s, one for each part.
struct SourceInParts {
    std::string name;
    std::vector<double> sds;
};

double root_mean_square(SpeedDistribution const& speeds, std::vector<double> const& sds) {
    double sum = 0;
    for (std::size_t i = 0; i < sds.size(); ++i) sum += speeds.shares[i] * sds[i] * sds[i];
    return std::sqrt(sum);
}

/// What the model itself, its unknown grains and the settings of the machine leave open.
std::vector<SourceInParts> sources_in_parts(ModelEfficiency const& median, std::string const& model,
                                            double trough_speed, SpeedDistribution const& speeds) {
    std::size_t const count = speeds.means.size();
    std::vector<SourceInParts> all;
    for (OwnSource const& one : median.sources)
        all.push_back({one.name, std::vector<double>(count, one.sd * trough_speed)});
    all.push_back({"stroke", std::vector<double>(count, speeds.settings.amplitude)});
    all.push_back({"vibration angle", std::vector<double>(count, speeds.settings.vibration_angle)});
    std::vector<double> density;
    for (double const mean : speeds.means) density.push_back(speeds.settings.bulk_density * std::abs(mean));
    all.push_back({"bulk density", density});
    std::vector<double> rest;
    for (std::size_t i = 0; i < count; ++i) {
        double variance = speeds.sds[i] * speeds.sds[i];
        for (SourceInParts const& one : all) variance -= one.sds[i] * one.sds[i];
        rest.push_back(std::sqrt(std::max(0.0, variance)));
    }
    all.push_back({fmt::format("error of {}", model), rest});
    return all;
}

/// The speeds if one of the sources in every part were known.
SpeedDistribution without(SpeedDistribution speeds, SourceInParts const& source) {
    for (std::size_t i = 0; i < speeds.sds.size(); ++i)
        speeds.sds[i] =
            std::sqrt(std::max(0.0, speeds.sds[i] * speeds.sds[i] - source.sds[i] * source.sds[i]));
    return speeds;
}

}  // namespace

std::vector<BudgetShare> budget_of(DesignTask const& task, DesignLayer const& layer, std::string const& model,
                                   ModelEfficiency const& median, SpeedDistribution const& speeds) {
    if (speeds.may_run_away()) return {};
    double const trough_speed = layer.drive.trough_speed();
    double const flow = task.bulk_density * task.width * layer.depth;
    double const sure = speeds.exceeded_with(task.confidence);
    std::vector<BudgetShare> all;
    auto const add = [&](std::string const& source, double sd, SpeedDistribution const& known) {
        if (sd > 1e-9 * trough_speed)
            all.push_back({source, flow * sd, flow * (known.exceeded_with(task.confidence) - sure)});
    };
    SpeedDistribution const one_friction{
        {1}, {median.efficiency * trough_speed}, {root_mean_square(speeds, speeds.sds)}};
    add("friction on the trough", speeds.sd_of_means(), one_friction);
    for (SourceInParts const& one : sources_in_parts(median, model, trough_speed, speeds))
        add(one.name, root_mean_square(speeds, one.sds), without(speeds, one));
    std::ranges::sort(all, std::greater(), &BudgetShare::sd);
    return all;
}

}  // namespace vibrotrough::learn
