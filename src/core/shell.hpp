#pragma once

#include <filesystem>
#include <string>

namespace vibrotrough::core {

/// The path as a word of a POSIX shell. It is in single quotes if it contains anything but letters, digits
/// and harmless punctuation, so that a command that the program prints can be pasted.
std::string shell_word(std::filesystem::path const& path);

}  // namespace vibrotrough::core
