#pragma once

#include "core/atomic_file.hpp"
#include "measure/cycle_series.hpp"
#include "measure/material_flow.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

/// @file
/// What comes, stays and goes in an open trough.

namespace vibrotrough::measure {

/// Reads left.STEP.dump of a packing, as parse_cycle_dumps().
/// @param is_mixture  the grains have types and masses
/// @throws InputError naming the file when it is damaged
std::vector<LeftGrain> parse_left(std::vector<core::TextFile> const& files, int steps_per_cycle,
                                  bool is_mixture);

/// Why the grains of an open trough or of a screen do not add up: at the end of every cycle those that were
/// there at the start and those that were fed are as many, and have the same mass, as those that are held and
/// those that left. None when they do.
std::optional<std::string> imbalance(CycleSeries const& series);

/// What the measurement of an open trough needs beside its cycles.
struct OpenFacts {
    double period;        ///< s, of a cycle
    double edge;          ///< m, where the trough ends
    int steps_per_cycle;  ///< time steps of the engine per cycle
    int discarded, used;  ///< cycles after number `discarded` up to number `used` are evaluated
    double bulk_density;  ///< kg/m^3, of the settled layer
    double width;         ///< m, of the trough
    double window;        ///< m, length of the window
    double box_section;   ///< m^2, of the box across the trough, to which the engine's densities refer
    /// m, the surface of a layer at rest above the trough's lowest point, from the middle of a bin and the
    /// mean depth there (m). Only of a trough with a mesh.
    std::function<double(double x, double mean_depth)> level = {};
    MixtureFacts mixture = {};  ///< of several materials
    /// s, the ends of cycle 0 ... n, where the cycles differ. The time to fill is not measured then.
    std::vector<double> ends = {};
};

/// Values along the trough, bin by bin from the back wall to the edge: means over the cycles.
struct AlongTrough {
    std::vector<double> x;           ///< m, middle of the bin
    std::vector<double> depth;       ///< m, height of the layer if it had settled, mean over the width
    std::vector<double> speed;       ///< m/s, of its grains; NaN where there was none
    std::vector<double> level = {};  ///< m, its surface above the trough's lowest point; only of a mesh
};

/// What was measured in one packing of an open trough. All but the time to fill are of the cycles that count.
struct OpenFlow {
    std::optional<double> inflow, outflow;   ///< kg/s
    std::optional<double> hold_up;           ///< kg, in the trough at the ends of the cycles
    std::optional<double> window_depth;      ///< m, of the settled layer in the window, mean over the width
    std::optional<double> residence_time;    ///< s, from the feed to the edge, mean of the grains that left
    std::optional<double> residence_spread;  ///< s, its standard deviation
    std::optional<double> peclet;            ///< see peclet_number()
    std::optional<double> fill_time;         ///< s, until the trough first held 95 % of hold_up
    AlongTrough along;                       ///< the layer along the trough
    std::vector<double> residence;           ///< s, 0, 1 ... 100 % of the grains stayed no longer
    MaterialsAlong materials_along = {};     ///< only of a mixture
    MaterialFlows materials = {};            ///< only of a mixture
};

/// Measures a packing, of whose grains the balance is known to hold.
/// @throws InputError when the grains that left are not those that were fed
OpenFlow open_flow(CycleSeries const& series, std::vector<LeftGrain> const& left,
                   std::vector<core::TextFile> const& files, std::filesystem::path const& folder,
                   OpenFacts const& facts);

/// How many cycles pass until the hold-up has no start-up any more: the rule MSER on its cycles, at most half
/// of them.
int cycles_to_fill(CycleSeries const& series);

/// The Peclet number v L / D of an axially dispersed stream in a vessel with closed ends, from the variance
/// of its residence times over the square of their mean: the solution of s = 2/Pe - 2/Pe^2 (1 - exp(-Pe))
/// (Levenspiel, Chemical Reaction Engineering, 3rd ed. 1999, Eq. 13.13). Infinite for plug flow, 0 for an
/// ideal mixer. None unless 0 < s < 1.
std::optional<double> peclet_number(double relative_variance);

}  // namespace vibrotrough::measure
