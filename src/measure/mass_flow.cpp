#include "measure/mass_flow.hpp"

#include "measure/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace vibrotrough::measure {
namespace {

/// Profiles reach from the trough to the highest grain, which is far less than this.
constexpr double most_slabs = 1e6;

/// The rows of one phase, from the bottom upwards, as a half-open range.
struct PhaseRows {
    std::size_t begin, end;
};

std::vector<PhaseRows> phases_of(Profiles const& profiles) {
    std::vector<PhaseRows> phases;
    for (std::size_t row = 0; row < profiles.phase.size(); ++row) {
        if (row == 0 || profiles.phase[row] != profiles.phase[row - 1]) phases.push_back({row, row});
        phases.back().end = row + 1;
    }
    return phases;
}

/// m, distance of two bins; 0 when there is only one.
double thickness_of(Profiles const& profiles) {
    if (profiles.phase.size() < 2 || profiles.phase[0] != profiles.phase[1]) return 0;
    return profiles.height[1] - profiles.height[0];
}

/// Mean over the phases in slabs of this thickness above the trough.
std::vector<double> flow_of(Profiles const& profiles, double thickness, double density) {
    std::vector<double> flow;
    std::vector<PhaseRows> const phases = phases_of(profiles);
    for (auto const& [begin, end] : phases) {
        for (std::size_t row = begin; row < end; ++row) {
            if (!(profiles.solid_fraction[row] > 0) || !std::isfinite(profiles.velocity_x[row])) continue;
            double const here = density * profiles.solid_fraction[row] * profiles.velocity_x[row];
            // The bin covers two slabs, the lower one by this share.
            double const bottom = profiles.height[row] / thickness - 0.5;
            double const lower = std::floor(bottom);
            if (!(std::abs(bottom) < most_slabs)) continue;
            double const share = 1 - (bottom - lower);
            for (auto const& [slab, part] : {std::pair{lower, share}, std::pair{lower + 1, 1 - share}}) {
                auto const place = static_cast<std::size_t>(std::max(slab, 0.0));
                if (part <= 0) continue;
                if (place >= flow.size()) flow.resize(place + 1, 0.0);
                flow[place] += here * part / static_cast<double>(phases.size());
            }
        }
    }
    return flow;
}

}  // namespace

std::optional<double> student_half_width(std::span<double const> values, double confidence) {
    if (values.size() < 2) return {};
    auto const count = static_cast<double>(values.size());
    double mean = 0, squares = 0;
    for (double const value : values) mean += value / count;
    for (double const value : values) squares += (value - mean) * (value - mean);
    return student_quantile(confidence, count - 1) * std::sqrt(squares / (count - 1) / count);
}

MassFlow mass_flow(std::span<Profiles const* const> packings, double density, double confidence) {
    std::vector<std::vector<double>> flows;
    double thickness = 0;
    for (Profiles const* const one : packings) {
        if (!(thickness_of(*one) > 0)) continue;
        if (thickness == 0) thickness = thickness_of(*one);
        flows.push_back(flow_of(*one, thickness, density));
    }
    MassFlow result;
    std::size_t slabs = 0;
    for (std::vector<double> const& flow : flows) slabs = std::max(slabs, flow.size());
    for (std::size_t slab = 0; slab < slabs; ++slab) {
        std::vector<double> values;
        double sum = 0;
        for (std::vector<double> const& flow : flows) {
            values.push_back(slab < flow.size() ? flow[slab] : 0.0);
            sum += values.back();
        }
        result.height.push_back((static_cast<double>(slab) + 0.5) * thickness);
        result.flow.push_back(sum / static_cast<double>(values.size()));
        result.half_width.push_back(
            student_half_width(values, confidence).value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    return result;
}

}  // namespace vibrotrough::measure
