#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace vibrotrough::core {

/// A folder that exists as long as this object. It has a unique name, only its owner can read it, and it is
/// removed with all its content in the end. Symbolic links in it are removed; their targets stay.
///
/// SIGINT, SIGTERM and SIGHUP remove it, too, where they would end the process. What SIGKILL leaves behind is
/// removed by the next process that makes such a folder (remove_left_folders()).
class TemporaryFolder {
  public:
    /// Makes the folder.
    /// @param purpose  beginning of the folder's name, such as "vibrotrough-probe"
    /// @param parent   below which it lies; empty: below TMPDIR, or below /tmp if that is not set
    /// @throws MissingError when the folder cannot be made: "cannot make a temporary folder in PARENT
    /// (reason)", and what to do if it is that of TMPDIR
    explicit TemporaryFolder(std::string_view purpose = "vibrotrough", std::filesystem::path parent = {});
    ~TemporaryFolder();
    TemporaryFolder(TemporaryFolder const&) = delete;
    TemporaryFolder& operator=(TemporaryFolder const&) = delete;

    std::filesystem::path const& path() const { return path_; }  ///< of the folder

    /// To be called in a child between fork and exec: the folder counts as in use until the child, and
    /// whatever inherits its files, has ended.
    void keep_in_child() const;
    /// Renames the folder, which then stays when this object ends. @return false when the disk refuses
    bool keep_as(std::filesystem::path const& name);
    /// Processes of this user that work below the folder or name it in their environment, besides this one.
    std::vector<int> users() const;

  private:
    std::filesystem::path path_;
    int lock_ = -1;  ///< descriptor of the folder, locked by its owner; -1 where there are no locks
};

/// Removes the temporary folders in `parent` that processes of this user left behind. The name of a folder
/// contains the kernel's boot id, so that those of other machines and of earlier boots stay, and its owner
/// holds a lock on it, which the kernel releases when the last process that inherited it has ended. A folder
/// that a process still works in or names in its environment stays, too.
/// @return how many were removed
int remove_left_folders(std::filesystem::path const& parent);

}  // namespace vibrotrough::core
