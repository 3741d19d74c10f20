#pragma once

#include "measure/layer_profiles.hpp"

#include <span>
#include <vector>

/// @file
/// How the materials of a mixture go through an open trough.

namespace vibrotrough::measure {

/// A grain that has left the trough.
struct LeftGrain {
    int cycle;        ///< at whose end it was found and taken out, from 1
    long id;          ///< its number; grains are numbered in the order in which they are fed
    double x;         ///< m, where it was then
    double vx;        ///< m/s, its speed along the trough
    int type = 0;     ///< atom type, which tells its material; only of a mixture
    double mass = 0;  ///< kg; only of a mixture
};

/// A mean residence time needs as many grains that left.
inline constexpr std::size_t fewest_stays = 20;

/// How long a grain that left had been in the trough.
struct Stay {
    double time;  ///< s, from the feed to the edge
    int type;     ///< as that of LeftGrain
};

/// The materials along the trough: a row for each bin of the first material, then for each of the second one,
/// and so on. Means over the cycles that count; NaN where there was none of it.
struct MaterialsAlong {
    std::vector<double> x;      ///< m, middle of the bin
    std::vector<double> share;  ///< its share of the mass in the bin
    std::vector<double> speed;  ///< m/s, mean over its mass
    /// The index S = (z - z_others) / (h / 2) of segregation_index(), with the depth h of the settled layer
    /// as a mean over the width; NaN where there is one material alone.
    std::vector<double> segregation;
};

/// The materials of an open trough, a row for each: means over the cycles that count.
struct MaterialFlows {
    std::vector<double> speed;           ///< m/s, in the window where the conveying speed is measured
    std::vector<double> segregation;     ///< in the window, mean of the bins weighted with their masses
    std::vector<double> outflow;         ///< kg/s, over the edge
    std::vector<double> residence_time;  ///< s, mean of its grains that left; NaN when fewer than 20 did
};

/// What is known of a mixture in an open trough.
struct MixtureFacts {
    std::vector<int> types = {};              ///< atom types of the materials; empty without a mixture
    double window_start = 0, window_end = 0;  ///< m, where the conveying speed is measured
};

/// @param snapshots  at the times that count, with the bins of the trough. These hold, behind the speed, for
///                   each material the means over all grains of m, m vx and m z, where m is the mass of a
///                   grain of this material, and 0 for others
/// @param depth      m, of the settled layer in each bin
MaterialsAlong materials_along(std::vector<Snapshot> const& snapshots, MixtureFacts const& facts,
                               std::span<double const> depth);

/// @param along  of the same materials
/// @param depth  m, of the settled layer in each bin
/// @param left   grains that left in the cycles that count
/// @param stays  of those of them that had been fed
/// @param time   s, of these cycles
MaterialFlows material_flows(MaterialsAlong const& along, std::span<double const> depth,
                             std::span<LeftGrain const> left, std::span<Stay const> stays, double time,
                             MixtureFacts const& facts);

}  // namespace vibrotrough::measure
