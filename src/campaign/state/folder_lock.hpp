#pragma once

#include "campaign/state/file_lock.hpp"

#include <filesystem>

namespace vibrotrough::campaign {

/// Holds a campaign folder for one driver; the kernel lets go when the driver ends, however it ends.
class FolderLock {
  public:
    /// @throws MissingError when another driver holds the folder
    explicit FolderLock(std::filesystem::path const& folder);

    /// Whether some driver holds the folder now.
    static bool is_held(std::filesystem::path const& folder);

  private:
    FileLock lock_;
};

}  // namespace vibrotrough::campaign
