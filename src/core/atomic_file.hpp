#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace vibrotrough::core {

/// The bytes of a whole file. @throws MissingError when it cannot be opened or read
std::string read_file(std::filesystem::path const& path);

/// The content of a file at one moment, together with its path.
struct TextFile {
    std::filesystem::path path;  ///< as it was given
    std::string content;         ///< all bytes of the file
};

/// Reads a whole file and keeps its path. @throws MissingError when it cannot be opened or read
TextFile read_text_file(std::filesystem::path const& path);

/// Creates the folder and its parents unless they exist.
/// @throws MissingError with the reason: permission, disk, or a file that has this name
void make_folder(std::filesystem::path const& path);

/// Calls `write` with the path of a temporary file in the folder of `path`, syncs that file to disk and
/// renames it to `path`. No reader ever sees a half-written `path`. The temporary file is removed if anything
/// throws.
/// @throws MissingError when the file cannot be written, and whatever `write` throws
void write_atomically(std::filesystem::path const& path,
                      std::function<void(std::filesystem::path const& temporary)> const& write);

/// Writes `content` in the same way.
/// @throws MissingError when the file cannot be written
void write_file_atomically(std::filesystem::path const& path, std::string_view content);

/// Writes `content` in the same way but does not sync it, because for a small file the sync takes much longer
/// than the rest. The file is never seen half-written while the machine runs, but it may be empty after a
/// power cut. Use it for files that are written again before each use.
/// @throws MissingError when the file cannot be written
void replace_file(std::filesystem::path const& path, std::string_view content);

}  // namespace vibrotrough::core
