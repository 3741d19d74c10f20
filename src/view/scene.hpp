#pragma once

#include "view/frames.hpp"

#include <filesystem>
#include <string_view>

namespace vibrotrough::view {

/// "velocity", "spin", "height", "trough", "size" or "material".
std::string_view name_of(Colour colour);
/// The reverse. @throws InputError when there is no such name
Colour colour_named(std::string_view name);

/// The space in which the grains of all frames were, with their radii, m.
struct GrainSpace {
    double left, right;  ///< along the trough
    double bottom, top;  ///< normal to it
};

/// Writes view_case.py, a ParaView state that opens grains.pvd and trough.pvd beside it from any working
/// folder, and view.sh, which starts ParaView with it. Returns the path of view_case.py.
/// @param scales  of the frames written so far; where they are 0, the first frame opened sets the colours
/// @param space   of these frames, which the camera shows; without it, that of the first frame opened
/// @throws MissingError when a file cannot be written
std::filesystem::path write_scene(FrameSource const& source, ColourScales const& scales,
                                  std::optional<GrainSpace> const& space,
                                  std::filesystem::path const& target);

}  // namespace vibrotrough::view
