#pragma once

#include <string_view>

/// @file
/// What people ask for and the program cannot simulate; src/manual/scope.md has the whole list.

namespace vibrotrough::scenario {

/// Something that cannot be simulated.
struct Cannot {
    std::string_view words;    ///< of a key, a section or a value that ask for it, with blanks between them
    std::string_view wrong;    ///< what cannot be simulated
    std::string_view instead;  ///< what can
};

/// What a key or a value that does not exist probably asks for; null when nothing is known of it.
Cannot const* cannot_simulate(std::string_view word);

}  // namespace vibrotrough::scenario
