#pragma once

#include "engine/engine.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace vibrotrough::engine {

/// What a probe deck dumps for one grain.
struct GrainSample {
    double x, z;    ///< m
    double vx, vz;  ///< m/s
    double spin;    ///< rad/s, about y
};

/// Reads the dumped samples: for each time a vector of grains, sorted by their numbers.
/// @throws InputError when the file is missing, incomplete, or holds a different number of grains
std::vector<std::vector<GrainSample>> read_samples(std::filesystem::path const& path, std::size_t grains);

/// One line of trough.csv.
struct TroughSample {
    double step;     ///< time step of the engine
    double x, z;     ///< m, displacement
    double force_z;  ///< N, on the trough
    double grains;   ///< number of grains
};

/// @throws InputError when the file is missing or incomplete
std::vector<TroughSample> read_trough_samples(std::filesystem::path const& path);

/// Why the run in this folder cannot be evaluated, in one line; empty if it ended normally.
std::string problem_of_run(std::filesystem::path const& folder, ExitStatus status);

}  // namespace vibrotrough::engine
