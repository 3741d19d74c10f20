#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace vibrotrough::core {

/// Reads a whole file. @throws MissingError when it cannot be opened or read.
std::string read_file(std::filesystem::path const& path);

/// A file's content as it was at one moment, and where it came from.
struct TextFile {
    std::filesystem::path path;
    std::string content;
};

/// @throws as read_file
TextFile read_text_file(std::filesystem::path const& path);

/// Makes the folder and its parents. @throws MissingError with the reason (permission, disk, a file in the
/// way).
void make_folder(std::filesystem::path const& path);

/// Lets `write` make a file under a temporary name beside `path`, syncs it to disk and renames it to `path`,
/// so that `path` is never seen half-written. The temporary file is removed when anything throws.
/// @throws MissingError when the disk refuses; whatever `write` throws
void write_atomically(std::filesystem::path const& path,
                      std::function<void(std::filesystem::path const& temporary)> const& write);

/// The same for a text that is already there.
void write_file_atomically(std::filesystem::path const& path, std::string_view content);

/// The same without the sync, which costs more than all else about a small file: never seen half-written
/// while the machine runs, but perhaps empty after a power cut. For files that are written anew before each
/// use.
void replace_file(std::filesystem::path const& path, std::string_view content);

}  // namespace vibrotrough::core
