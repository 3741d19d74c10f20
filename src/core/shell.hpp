#pragma once

#include <filesystem>
#include <string>

namespace vibrotrough::core {

/// The path as a word for a POSIX shell: in single quotes when it holds anything but plain characters, so
/// that a command that the program prints can be pasted.
std::string shell_word(std::filesystem::path const& path);

}  // namespace vibrotrough::core
