#include "measure/material_flow.hpp"

#include <cmath>
#include <limits>

namespace vibrotrough::measure {
namespace {

/// Of one material in one bin, sums over the snapshots.
struct BinSums {
    double mass = 0, momentum = 0, moment = 0;
};

double ratio(double a, double b) {
    return b > 0 ? a / b : std::numeric_limits<double>::quiet_NaN();
}

BinSums sums_of(std::vector<Snapshot> const& snapshots, std::size_t bin, std::size_t material) {
    BinSums sums;
    for (Snapshot const& one : snapshots) {
        Bin const& content = one.bins.at(bin);
        std::size_t const first = 1 + 3 * material;
        sums.mass += content.grains * content.means.at(first);
        sums.momentum += content.grains * content.means.at(first + 1);
        sums.moment += content.grains * content.means.at(first + 2);
    }
    return sums;
}

/// The mean of a column in the window, where each bin counts with the mass of the material in it, or, for the
/// index of segregation, of all materials.
double mean_in_window(MaterialsAlong const& along, std::vector<double> const& column, std::size_t material,
                      std::span<double const> depth, bool of_material, MixtureFacts const& facts) {
    double sum = 0, weights = 0;
    for (std::size_t bin = 0; bin < depth.size(); ++bin) {
        std::size_t const row = material * depth.size() + bin;
        bool const is_inside = along.x[row] >= facts.window_start && along.x[row] <= facts.window_end;
        if (!is_inside || std::isnan(column[row])) continue;
        double const weight = depth[bin] * (of_material ? along.share[row] : 1);
        sum += weight * column[row];
        weights += weight;
    }
    return ratio(sum, weights);
}

}  // namespace

MaterialsAlong materials_along(std::vector<Snapshot> const& snapshots, MixtureFacts const& facts,
                               std::span<double const> depth) {
    MaterialsAlong along;
    for (std::size_t material = 0; material < facts.types.size(); ++material) {
        for (std::size_t bin = 0; bin < depth.size(); ++bin) {
            BinSums const own = sums_of(snapshots, bin, material);
            BinSums others;
            for (std::size_t other = 0; other < facts.types.size(); ++other) {
                if (other == material) continue;
                BinSums const sums = sums_of(snapshots, bin, other);
                others.mass += sums.mass;
                others.moment += sums.moment;
            }
            along.x.push_back(snapshots.front().bins[bin].position);
            along.share.push_back(ratio(own.mass, own.mass + others.mass));
            along.speed.push_back(ratio(own.momentum, own.mass));
            double const above = ratio(own.moment, own.mass) - ratio(others.moment, others.mass);
            along.segregation.push_back(above / (depth[bin] / 2));
        }
    }
    return along;
}

MaterialFlows material_flows(MaterialsAlong const& along, std::span<double const> depth,
                             std::span<LeftGrain const> left, std::span<Stay const> stays, double time,
                             MixtureFacts const& facts) {
    MaterialFlows flows;
    for (std::size_t material = 0; material < facts.types.size(); ++material) {
        int const type = facts.types[material];
        flows.speed.push_back(mean_in_window(along, along.speed, material, depth, true, facts));
        flows.segregation.push_back(mean_in_window(along, along.segregation, material, depth, false, facts));
        double mass = 0, stayed = 0;
        std::size_t count = 0;
        for (LeftGrain const& grain : left)
            if (grain.type == type) mass += grain.mass;
        for (Stay const& stay : stays) {
            if (stay.type != type) continue;
            stayed += stay.time;
            ++count;
        }
        flows.outflow.push_back(mass / time);
        flows.residence_time.push_back(count < fewest_stays ? std::numeric_limits<double>::quiet_NaN()
                                                            : stayed / static_cast<double>(count));
    }
    return flows;
}

}  // namespace vibrotrough::measure
