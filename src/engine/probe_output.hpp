#pragma once

#include "engine/engine.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace vibrotrough::engine {

/// What a probe's deck dumps of one grain.
struct GrainSample {
    double x, z;    ///< m
    double vx, vz;  ///< m/s
    double spin;    ///< rad/s, about y
};

/// The dumped samples, one vector of grains (sorted by number) per time.
/// @throws InputError when the file is missing, cut, or holds another number of grains
std::vector<std::vector<GrainSample>> read_samples(std::filesystem::path const& path, std::size_t grains);

/// One line of trough.csv.
struct TroughSample {
    double step;     ///< time step of the engine
    double x, z;     ///< m, displacement
    double force_z;  ///< N, on the trough
    double grains;   ///< number of grains
};

/// @throws InputError when the file is missing or cut
std::vector<TroughSample> read_trough_samples(std::filesystem::path const& path);

/// Why the run in this folder counts for nothing, in one line; empty when it ended well.
std::string problem_of_run(std::filesystem::path const& folder, ExitStatus status);

}  // namespace vibrotrough::engine
