# Writes a header with the template of the scene and its start script as raw string literals.
file(READ ${SCENE} scene)
file(READ ${STARTER} starter)
file(WRITE ${OUTPUT} "#pragma once

#include <string_view>

namespace vibrotrough::view {

/// postprocess/vibrotrough/paraview/view_case.py
inline constexpr std::string_view scene_template = R\"scene(${scene})scene\";

/// postprocess/vibrotrough/paraview/view.sh
inline constexpr std::string_view scene_starter = R\"scene(${starter})scene\";

}  // namespace vibrotrough::view
")
