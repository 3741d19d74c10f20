#pragma once

#include <filesystem>
#include <optional>
#include <utility>

namespace vibrotrough::engine {

/// Notices that a folder was renamed, moved or removed while an engine works in it. The engine then goes on
/// in the folder, but its files are no longer where they are looked for, which would seem to be its fault.
class FolderWatch {
  public:
    /// Begins to watch a folder. One that is not there is not watched.
    explicit FolderWatch(std::filesystem::path folder);
    /// @throws core::MissingError when something else, or nothing, is under its path
    void check() const;

  private:
    std::filesystem::path folder_;
    std::optional<std::pair<unsigned long, unsigned long>> identity_;  ///< device and inode
};

}  // namespace vibrotrough::engine
