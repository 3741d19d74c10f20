#pragma once

#include "campaign/state/overview.hpp"
#include "core/temporary_folder.hpp"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace vibrotrough::archive {

/// A bundle whose files are what its checksums say.
struct OpenBundle {
    std::filesystem::path folder;               ///< of the campaign, for campaign::open_plan()
    campaign::Activity activity;                ///< what was known of cases that ended without a result
    std::size_t results = 0;                    ///< cases that have one, by the program that made the bundle
    std::string program_version;                ///< of that program
    std::shared_ptr<void const> unpacked = {};  ///< keeps the folder, unless it is the user's own
};

/// Opens a bundle: the ZIP file, whose campaign is unpacked into a private temporary folder, or the folder to
/// which somebody has unpacked it, in which nothing is written.
/// @return none when the path leads to a folder that is not an unpacked bundle
/// @throws core::InputError when a file is missing, was added or changed, or when the file is not a bundle;
/// see also read_zip()
/// @throws core::MissingError when a file cannot be read or the disk refuses
std::optional<OpenBundle> open_bundle(std::filesystem::path const& path);

}  // namespace vibrotrough::archive
