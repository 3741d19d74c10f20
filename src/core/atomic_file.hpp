#pragma once

#include "core/open_file.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace vibrotrough::core {

/// The largest file that is read as a whole, in bytes: a file of phases of 200,000 cycles, or a restart file
/// of ten million grains.
constexpr std::size_t largest_file = std::size_t{4} << 30;

/// The largest file of facts (JSON, TOML, a deck, a marker) that is read, in bytes.
constexpr std::size_t largest_note = std::size_t{64} << 20;

/// The bytes of a whole file. Only a regular file is read: a pipe or a device would never end.
/// @param limit  bytes; a longer file is refused before anything of it is read
/// @throws MissingError when it cannot be opened or read, or is not a regular file of this size
std::string read_file(std::filesystem::path const& path, std::size_t limit = largest_file);

/// The same for a file that the user has named on the command line, which may be a pipe.
/// @throws MissingError when it cannot be opened or read, or is longer than `limit`
std::string read_given_file(std::filesystem::path const& path, std::size_t limit = largest_note);

/// The content of a file at one moment, together with its path.
struct TextFile {
    std::filesystem::path path;  ///< as it was given
    std::string content;         ///< all bytes of the file
};

/// Reads a whole file and keeps its path. @throws MissingError as read_file()
TextFile read_text_file(std::filesystem::path const& path);

/// Whether a file is on the disk, and not only with the kernel, when it gets its name.
enum class Sync { yes, no };

/// A file that appears whole or not at all: it is written as NAME.part in its folder, and renamed in the end.
/// Two processes that write the same file do it one after the other. What a killed process leaves is used by
/// the next one. A file that is replaced hands on its mode.
class NewFile {
  public:
    /// Begins the file. @throws MissingError when it cannot be made or would replace something that is not a
    /// file, a DiskFullError when the disk is full
    explicit NewFile(std::filesystem::path path);
    /// Removes what was written, unless it was finished.
    ~NewFile();
    NewFile(NewFile const&) = delete;
    NewFile& operator=(NewFile const&) = delete;

    /// The open file, for a library that writes it.
    int descriptor() const { return file_.number(); }
    /// Its name until it is finished, for a library that opens it itself.
    std::filesystem::path const& temporary() const { return temporary_; }
    /// Adds bytes. @throws MissingError as the constructor
    void write(std::string_view bytes) const;
    /// Gives the file its name. @throws MissingError as the constructor
    void finish(Sync sync);
    /// Throws what errno says of an attempt to write the file.
    [[noreturn]] void refuse() const;

  private:
    std::filesystem::path path_, temporary_;
    Descriptor file_;
};

/// Writes a file that appears whole and stays after a power cut. A pipe or a character device in its place is
/// written into; a disk, a socket, and a link to any of them are refused.
/// @throws MissingError when the file cannot be written, a DiskFullError when the disk is full
void write_file_atomically(std::filesystem::path const& path, std::string_view content);

/// Writes `content` in the same way but does not sync it, because for a small file the sync takes much longer
/// than the rest. The file is never seen half-written while the machine runs, but it may be empty after a
/// power cut. Use it for files that are written again before each use.
/// @throws MissingError when the file cannot be written
void replace_file(std::filesystem::path const& path, std::string_view content);

/// Makes the folder and its parents unless they exist.
/// @throws MissingError with the reason: permission, disk, a file that has this name
void make_folder(std::filesystem::path const& path);

}  // namespace vibrotrough::core
