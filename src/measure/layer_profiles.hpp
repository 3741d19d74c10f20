#pragma once

#include "core/atomic_file.hpp"

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace vibrotrough::measure {

/// The content of one bin at one time, as written by the engine.
struct Bin {
    double position;            ///< m, middle of the bin
    double grains;              ///< number of grains with their centres in the bin
    double density;             ///< kg/m^3, mass of these grains divided by the volume of the bin
    std::vector<double> means;  ///< means over these grains of the quantities that the deck selects
};

/// What the engine found in all bins at one moment.
struct Snapshot {
    long step;              ///< time step of the engine
    std::vector<Bin> bins;  ///< in the order of their places
};

/// Reads the snapshots of a packing from `NAME.STEP.txt`, one file for each start of the engine, with STEP
/// the first step. Snapshots that a later run repeated replace those of the earlier run. An incomplete last
/// snapshot is left out, because the engine may still be writing it.
/// @param name  "profiles" or "surface"
/// @throws InputError naming file and line when a line is damaged
/// @throws MissingError if there is no such file
std::vector<Snapshot> read_snapshots(std::filesystem::path const& folder, std::string_view name);

/// The same for files that have already been read; files with other names are ignored.
/// @param folder  named in error messages
std::vector<Snapshot> parse_snapshots(std::vector<core::TextFile> const& files,
                                      std::filesystem::path const& folder, std::string_view name);

/// The data needed in addition to the snapshots.
struct ProfileFacts {
    double density;       ///< kg/m^3, of the material of the grains
    int steps_per_cycle;  ///< time steps of the engine per cycle
    int discarded, used;  ///< cycles after number `discarded` up to number `used` are evaluated
    int phases;           ///< snapshots per cycle, evenly spaced
    std::vector<double> trough_z, trough_vx, trough_vz;  ///< m and m/s, of the trough at each of these phases
    double conveying_speed;                              ///< m/s
};

/// Profiles normal to the trough as rows: the phases in order from phase 0, and for each phase the bins from
/// the bottom upwards.
struct Profiles {
    std::vector<double> phase;   ///< rad
    std::vector<double> height;  ///< m, middle of the bin above the trough
    std::vector<double>
        solid_fraction;  ///< volume of the grains with their centres in the bin over its volume
    std::vector<double> velocity_x, velocity_z;  ///< m/s, relative to the trough; NaN where no grain ever was
    /// Mean velocity along the trough of the upper third of the layer's mass less that of the lower third,
    /// over the conveying speed; no value when the layer is not conveyed or never seen.
    std::optional<double> velocity_gradient;
};

/// Means of the snapshots of the cycles that count, phase by phase.
Profiles layer_profiles(std::vector<Snapshot> const& snapshots, ProfileFacts const& facts);

/// The surface of the layer along the trough as rows: the phases in order, and for each phase the columns.
struct Surface {
    std::vector<double> phase;   ///< rad
    std::vector<double> x;       ///< m, middle of the column
    std::vector<double> height;  ///< m, of the surface above the trough: twice the mean height of the
                                 ///< column's grains; of the last snapshot at that phase
    /// m, of a sinusoid with the same variance along the trough, root mean square over all snapshots. Columns
    /// of single grains are never quite level: a layer without waves has a quarter of a diameter. No value
    /// without snapshots.
    std::optional<double> wiggle_amplitude;
};

/// The surface at the last snapshot of each phase.
Surface layer_surface(std::vector<Snapshot> const& snapshots, ProfileFacts const& facts);

}  // namespace vibrotrough::measure
