#pragma once

#include <filesystem>

namespace vibrotrough::campaign {

/// Holds a campaign folder for one driver; the kernel lets go when the driver ends, however it ends.
class FolderLock {
  public:
    /// @throws MissingError when another driver holds the folder
    explicit FolderLock(std::filesystem::path const& folder);
    ~FolderLock();
    FolderLock(FolderLock const&) = delete;
    FolderLock& operator=(FolderLock const&) = delete;

    /// Whether some driver holds the folder now.
    static bool is_held(std::filesystem::path const& folder);

  private:
    int descriptor_;
};

}  // namespace vibrotrough::campaign
