#pragma once

#include <filesystem>
#include <string_view>

namespace vibrotrough::core {

/// A folder of its own for as long as the object lives: made under a name that nobody else has, readable by
/// its owner only, and removed with all that is in it. Symbolic links in it are removed, and what they point
/// to stays.
class TemporaryFolder {
  public:
    /// @param purpose  begins the folder's name, such as "vibrotrough-probe"
    /// Makes the folder below TMPDIR, or below /tmp when that is not set.
    /// @throws MissingError when the folder cannot be made
    explicit TemporaryFolder(std::string_view purpose = "vibrotrough");
    ~TemporaryFolder();
    TemporaryFolder(TemporaryFolder const&) = delete;
    TemporaryFolder& operator=(TemporaryFolder const&) = delete;

    std::filesystem::path const& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace vibrotrough::core
