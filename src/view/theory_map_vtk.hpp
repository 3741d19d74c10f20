#pragma once

#include "theory/map.hpp"

#include <filesystem>

namespace vibrotrough::view {

/// Writes a map of the point-mass theory for ParaView: `path` (.vti) with velocity efficiency, mode and
/// period at the points of the grid, x and y the two inputs; infinite efficiencies as NaN. Inline binary,
/// under a temporary name.
/// @throws MissingError when the disk refuses
void write_theory_image(std::filesystem::path const& path, theory::Map const& map);

/// The lines between the modes as a .vtp beside it.
void write_theory_boundaries(std::filesystem::path const& path, theory::Map const& map);

}  // namespace vibrotrough::view
