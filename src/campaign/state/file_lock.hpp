#pragma once

#include "core/open_file.hpp"

#include <filesystem>
#include <optional>
#include <utility>

namespace vibrotrough::campaign {

/// An exclusive lock on a file; the kernel lets go when the process ends, however it ends. Also between
/// machines, where the file system knows locks (NFS 4 does).
class FileLock {
  public:
    /// Takes the lock, or gives nothing when another process has it.
    /// @throws MissingError when the file cannot be made
    static std::optional<FileLock> take(std::filesystem::path const& path);

    /// Takes the lock as soon as nobody else has it.
    /// @throws MissingError when the file cannot be made
    static FileLock wait_for(std::filesystem::path const& path);

    /// Whether somebody has it now; asking does not disturb.
    static bool is_held(std::filesystem::path const& path);

  private:
    explicit FileLock(core::Descriptor file) : file_(std::move(file)) {}

    core::Descriptor file_;
};

/// Holds a campaign folder for one driver. @throws MissingError when another driver holds it
FileLock lock_campaign(std::filesystem::path const& folder);

/// Whether some driver holds the folder now.
bool has_driver(std::filesystem::path const& folder);

}  // namespace vibrotrough::campaign
