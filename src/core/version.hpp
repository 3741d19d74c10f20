#pragma once

#include <string_view>

namespace vibrotrough::core {

/// Version of the program, e.g. "0.2.0".
std::string_view program_version();

/// Git commit from which the program was built, 12 digits, with "-dirty" appended if the sources had
/// uncommitted changes; "unknown" when it was not built in a git repository.
std::string_view program_commit();

}  // namespace vibrotrough::core
