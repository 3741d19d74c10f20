#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace vibrotrough::core {

/// A folder whose content belongs to this program, such as that of a campaign. While an object for it exists,
/// the functions of this file and those of atomic_file.hpp change only what really lies below the folder:
/// they follow no symbolic link on the way from the folder to a file. (Links on the way to the folder itself
/// are the user's own choice and are followed.) When the folder is moved or removed meanwhile, nothing is
/// made again in its place.
///
/// A path is taken to be below the folder when it begins with the folder's path, as given or absolute.
class OwnFolder {
  public:
    /// @throws MissingError when the folder cannot be opened
    explicit OwnFolder(std::filesystem::path const& folder);
    ~OwnFolder();
    OwnFolder(OwnFolder const&) = delete;
    OwnFolder& operator=(OwnFolder const&) = delete;

    struct Root;  ///< the open folder and its names

  private:
    std::shared_ptr<Root> root_;
};

/// The folder in which a file or folder is to be opened, renamed or removed, held open: what happens to its
/// path meanwhile does not matter.
class ParentFolder {
  public:
    /// Opens the folder of `path`. Below an OwnFolder no symbolic link is followed. Check is_open().
    explicit ParentFolder(std::filesystem::path const& path);
    ~ParentFolder();
    ParentFolder(ParentFolder const&) = delete;
    ParentFolder& operator=(ParentFolder const&) = delete;

    bool is_open() const { return descriptor_ >= 0; }   ///< otherwise errno says why not
    int descriptor() const { return descriptor_; }      ///< of the folder; -1 when it is not open
    char const* name() const { return name_.c_str(); }  ///< of the entry in the folder
    /// Opens the entry as open(2) does, but never through a symbolic link. @return -1 with errno on failure
    int open(int flags) const;

  private:
    std::string name_;
    int descriptor_;
};

/// Makes the folder and its parents unless they exist.
/// @throws MissingError with the reason: permission, disk, a file that has this name, or a symbolic link
/// below an OwnFolder
void make_folder(std::filesystem::path const& path);

/// Removes a file, or a symbolic link itself. It is no error when there is none.
/// @throws MissingError with the reason
void remove_file(std::filesystem::path const& path);

/// Removes a file, or a folder with all its content. Symbolic links in it are removed; what they lead to
/// stays. It is no error when there is nothing.
/// @throws MissingError with the reason
void remove_tree(std::filesystem::path const& path);

/// Removes a folder if it is empty; does nothing otherwise.
void remove_if_empty(std::filesystem::path const& folder);

/// Renames a file or folder as rename(2) does. @throws MissingError with the reason
void rename_entry(std::filesystem::path const& from, std::filesystem::path const& to);

/// Gives a file a second name, or copies it where the file system knows no hard links. An entry that has the
/// name `to` is replaced. @throws MissingError with the reason
void link_or_copy(std::filesystem::path const& from, std::filesystem::path const& to);

/// To be called before another program writes to a file: a symbolic link, pipe or device in its place is
/// refused, and a file that has further names gets a content of its own, so that only this one changes. It is
/// no error when there is no such file.
/// @throws MissingError with the reason
void check_own_file(std::filesystem::path const& path);

/// Whether the path itself is a symbolic link, wherever it leads.
bool is_link(std::filesystem::path const& path);

/// reason_of(errno) of limits.hpp, and what a symbolic link on the way means.
std::string reason_of_errno();

/// Opens `relative` below an open folder without following any symbolic link and without leaving the folder.
/// The kernel does it in one step where it can (openat2, Linux 5.6).
/// @return -1 with errno on failure
int open_beneath(int folder, std::filesystem::path const& relative, int flags);

/// The same, folder by folder, as it is done where the kernel lacks openat2 or a container forbids it.
int open_beneath_stepwise(int folder, std::filesystem::path const& relative, int flags);

}  // namespace vibrotrough::core
