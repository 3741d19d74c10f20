#pragma once

#include "scenario/model/trough_mesh.hpp"

#include <string>
#include <string_view>
#include <vector>

/// @file
/// Triangles and solids of an STL file, as they stand there.

namespace vibrotrough::scenario {

/// More triangles are not read: one more shows that there are too many.
inline constexpr std::size_t most_triangles = 5'000;

/// What an STL file says. Lengths are in the unit of the file.
struct Solids {
    std::vector<Triangle> triangles;     ///< at most most_triangles + 1
    std::vector<std::string> parts;      ///< names of the solids that have triangles, each once
    std::vector<std::size_t> part_of{};  ///< of each triangle the index in `parts`
    bool is_binary = false;              ///< not a text
};

/// A name such as a campaign file may have: '_' for all but letters, digits, '.' and '-'.
std::string part_name(std::string text);

/// Reads an STL file, text or binary. @throws std::invalid_argument saying what is wrong with it
Solids read_stl(std::string_view content);

}  // namespace vibrotrough::scenario
