#pragma once

#include <filesystem>
#include <string_view>

namespace vibrotrough::core {

/// A folder that exists as long as this object. It has a unique name, only its owner can read it, and it is
/// removed with all its content in the end. A process that a signal ends leaves it behind.
class TemporaryFolder {
  public:
    /// Makes the folder below TMPDIR, or below /tmp if that is not set.
    /// @param purpose  beginning of the folder's name, such as "vibrotrough-probe"
    /// @throws MissingError when the folder cannot be made
    explicit TemporaryFolder(std::string_view purpose = "vibrotrough");
    ~TemporaryFolder();
    TemporaryFolder(TemporaryFolder const&) = delete;
    TemporaryFolder& operator=(TemporaryFolder const&) = delete;

    std::filesystem::path const& path() const { return path_; }  ///< of the folder

  private:
    std::filesystem::path path_;
};

}  // namespace vibrotrough::core
