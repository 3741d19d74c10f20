#pragma once

#include "core/atomic_file.hpp"

#include <filesystem>
#include <string_view>
#include <vector>

namespace vibrotrough::measure {

/// What the engine found in one bin at one moment.
struct Bin {
    double place;               ///< m, middle of the bin
    double grains;              ///< with their centres in the bin
    double density;             ///< kg/m^3, mass of those grains over the bin's volume
    std::vector<double> means;  ///< over those grains, as the deck asks
};

/// What the engine found in all bins at one moment.
struct Snapshot {
    long step;              ///< time step of the engine
    std::vector<Bin> bins;  ///< in the order of their places
};

/// Reads the snapshots of a packing: `NAME.STEP.txt`, one file for each time the engine was started, STEP
/// where it started. What a later run did again replaces what the earlier one had written. A last snapshot
/// that is not whole is left out: the engine may be writing it.
/// @param name  "profiles" or "surface"
/// @throws InputError naming file and line when a line is damaged
/// @throws MissingError when there is no such file
std::vector<Snapshot> read_snapshots(std::filesystem::path const& folder, std::string_view name);

/// The same of files that were read before; those with other names are passed over.
/// @param folder  for messages
std::vector<Snapshot> parse_snapshots(std::vector<core::TextFile> const& files,
                                      std::filesystem::path const& folder, std::string_view name);

/// What is needed beside the snapshots.
struct ProfileFacts {
    double density;       ///< kg/m^3, of the grains' material
    int steps_per_cycle;  ///< time steps of the engine per cycle
    int discarded, used;  ///< cycles: those after `discarded`, up to `used`, count
    int phases;           ///< snapshots per cycle, evenly spaced
    std::vector<double> trough_z, trough_vx, trough_vz;  ///< of the trough at each of these phases, m, m/s
    double conveying_speed;                              ///< m/s
};

/// Profiles normal to the trough, row by row: phases in order, and in each the bins upwards. Phase 0 is
/// first.
struct Profiles {
    std::vector<double> phase;   ///< rad
    std::vector<double> height;  ///< m, middle of the bin above the trough
    std::vector<double>
        solid_fraction;  ///< volume of the grains with their centres in the bin over its volume
    std::vector<double> velocity_x, velocity_z;  ///< m/s, relative to the trough; NaN where no grain ever was
    /// Mean velocity along the trough of the upper third of the layer's mass less that of the lower third,
    /// over the conveying speed; NaN when the layer is not conveyed or never seen.
    double velocity_gradient;
};

/// Means of the snapshots of the cycles that count, phase by phase.
Profiles layer_profiles(std::vector<Snapshot> const& snapshots, ProfileFacts const& facts);

/// The layer's surface along the trough, row by row: phases in order, and in each the columns.
struct Surface {
    std::vector<double> phase;   ///< rad
    std::vector<double> x;       ///< m, middle of the column
    std::vector<double> height;  ///< m, of the surface above the trough: twice the mean height of the
                                 ///< column's grains; of the last snapshot at that phase
    /// m, of a sinusoid with the same variance along the trough, root mean square over all snapshots. Columns
    /// of single grains are never quite level: a layer without waves has a quarter of a diameter.
    double wiggle_amplitude;
};

/// The surface at the last snapshot of each phase.
Surface layer_surface(std::vector<Snapshot> const& snapshots, ProfileFacts const& facts);

}  // namespace vibrotrough::measure
