#pragma once

#include <filesystem>
#include <optional>

namespace vibrotrough::core {

/// The file of the running program; none when the kernel does not tell it (/proc is not mounted). Files
/// beside the program are found from there and never from the current folder, which may be somebody else's.
std::optional<std::filesystem::path> find_own_program();

/// The same. @throws MissingError when there is none
std::filesystem::path own_program();

}  // namespace vibrotrough::core
