#pragma once

#include "core/atomic_file.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace vibrotrough::campaign {

/// What a packing's run wrote, read once: what is measured is what the digests are of.
struct PackingOutputs {
    std::filesystem::path folder;
    core::TextFile cycles, phases;          ///< empty when there is no such file
    std::vector<core::TextFile> snapshots;  ///< of profiles and surface, by name

    /// Of cycles.csv; empty without it.
    std::string digest_of_cycles() const;

    /// Of all that was written within the cycles.
    std::string digest_of_layer() const;
};

/// @throws MissingError when a file cannot be read
PackingOutputs read_outputs(std::filesystem::path const& folder);

}  // namespace vibrotrough::campaign
