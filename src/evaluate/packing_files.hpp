#pragma once

#include "core/atomic_file.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::evaluate {

/// What the run of a packing wrote, read and hashed once: the digests are of the very bytes that are
/// measured.
struct PackingFiles {
    std::filesystem::path folder;           ///< of the packing
    core::TextFile cycles, phases;          ///< empty when there is no such file
    std::vector<core::TextFile> snapshots;  ///< of profiles, surface ..., by name
    std::string cycles_sha256;              ///< of cycles.csv; empty without it
    std::string layer_sha256;               ///< of everything that was written within the cycles
};

/// @throws core::MissingError when a file cannot be read
PackingFiles read_packing_files(std::filesystem::path const& folder);

/// How a packing was run whose engine ended normally: the marker packing.json in its folder.
struct PackingMarker {
    double wall_time;                                              ///< s
    std::string started, finished;                                 ///< ISO 8601, UTC
    std::string program_version = "", git_commit = "", host = "";  ///< that ran it
    std::string engine_certificate = "";                           ///< JSON; empty when it was not probed
    /// s, processor time of the engine on all of its ranks; up to version 0.1 the wall time stands for it
    double core_time = 0;
    /// Velocity efficiency with which all grains started; none when they started at rest.
    std::optional<double> start_efficiency = {};
    std::string deck_sha256 = "";  ///< of in.liggghts as it was run; empty up to version 0.2
};

/// Whether the folder has a marker, whatever it is worth.
bool has_marker(std::filesystem::path const& packing_folder);

/// packing.json. @throws core::note::Fault when the text is not a marker of these files
PackingMarker parse_marker(std::string_view text, PackingFiles const& files);

/// The text of packing.json.
std::string to_json(PackingFiles const& files, PackingMarker const& marker);

/// The packing's marker, if there is one and the files are still what they were when it was written.
std::optional<PackingMarker> read_marker(PackingFiles const& files);

/// The same of a folder whose files were not read yet.
std::optional<PackingMarker> read_marker(std::filesystem::path const& packing_folder);

/// Writes the marker: from now on the packing is not run again.
/// @throws core::MissingError when the disk refuses
void write_marker(PackingFiles const& files, PackingMarker const& marker);

/// Removes the marker, so that the packing is run again.
void remove_marker(std::filesystem::path const& packing_folder);

}  // namespace vibrotrough::evaluate
