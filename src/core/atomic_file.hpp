#pragma once

#include "core/own_folder.hpp"  // make_folder() and the like, which are used together with these

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

/// The same into a text whose memory is used again, for many files one after the other.
void read_file_into(std::filesystem::path const& path, std::string& content,
                    std::size_t limit = largest_file);

/// The same for a file that the user has named on the command line, which may be a pipe.
/// @throws MissingError when it cannot be opened or read, or is longer than `limit`
std::string read_given_file(std::filesystem::path const& path, std::size_t limit = largest_note);

/// The same as read_file() for a file that must not be reached through a symbolic link: neither the file
/// itself nor, below an OwnFolder, a folder on the way to it may be one.
/// @throws MissingError as read_file(), and when there is a link
std::string read_own_file(std::filesystem::path const& path, std::size_t limit = largest_file);

/// The content of a file at one moment, together with its path.
struct TextFile {
    std::filesystem::path path;  ///< as it was given
    std::string content;         ///< all bytes of the file
};

/// Reads a whole file and keeps its path. @throws MissingError as read_file()
TextFile read_text_file(std::filesystem::path const& path);

/// Writes a temporary file in the folder of `path`, syncs it to disk and renames it to `path`. No reader ever
/// sees a half-written `path`. Neither of the two is written through a symbolic link: one that has its name
/// is replaced. A file that is replaced hands on its owner and its mode. Outside of an OwnFolder, a pipe or a
/// character device is written into, and a link to one is refused. Below an OwnFolder, temporary files of
/// `path` that a killed process left are removed.
/// @throws MissingError when the file cannot be written, a DiskFullError when the disk is full
void write_file_atomically(std::filesystem::path const& path, std::string_view content);

/// Writes `content` in the same way but does not sync it, because for a small file the sync takes much longer
/// than the rest. The file is never seen half-written while the machine runs, but it may be empty after a
/// power cut. Use it for files that are written again before each use.
/// @throws MissingError when the file cannot be written
void replace_file(std::filesystem::path const& path, std::string_view content);

/// Removes the temporary files of `path` that a killed process left below an OwnFolder, as the next write of
/// `path` would. Those that another process still writes stay. For files that may never be written again.
void remove_remains_of(std::filesystem::path const& path);

}  // namespace vibrotrough::core
