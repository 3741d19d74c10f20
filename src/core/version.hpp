#pragma once

#include <string_view>

namespace vibrotrough::core {

/// Version of the program, e.g. "0.1.0".
std::string_view program_version();

/// Git commit the program was built from, with "-dirty" when the tree had changes; "unknown" outside git.
std::string_view program_commit();

}  // namespace vibrotrough::core
