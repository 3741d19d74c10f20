#pragma once

#include <filesystem>

namespace vibrotrough::core {

/// Whether a file lies below an OwnFolder of this process, where the program's temporary files are its own.
bool lies_in_own_folder(std::filesystem::path const& path);

}  // namespace vibrotrough::core
