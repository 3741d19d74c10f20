#pragma once

#include "view/frames.hpp"

#include <filesystem>

namespace vibrotrough::view {

/// Writes view_case.py, a ParaView state that opens grains.pvd and trough.pvd beside it from any working
/// folder, and view.sh, which starts ParaView with it. Returns the path of view_case.py.
/// @throws MissingError when a file cannot be written
std::filesystem::path write_scene(FrameSource const& source, std::filesystem::path const& target);

}  // namespace vibrotrough::view
