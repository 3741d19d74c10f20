#pragma once

#include "theory/map.hpp"

#include <filesystem>

namespace vibrotrough::view {

/// By which both files of a map are recognised: the name of an array without meaning near their begin.
inline constexpr char const* theory_map_mark = "vibrotrough_theory_map";

/// Writes a map of the point-mass theory for ParaView to `path` (.vti): velocity efficiency, mode and period
/// at the points of the grid, with the two inputs as x and y. Infinite efficiencies are written as NaN. The
/// data are inline binary; the file is written under a temporary name and renamed.
/// @throws MissingError when the file cannot be written
void write_theory_image(std::filesystem::path const& path, theory::Map const& map);

/// Writes the boundaries between modes as a .vtp file next to it.
void write_theory_boundaries(std::filesystem::path const& path, theory::Map const& map);

}  // namespace vibrotrough::view
