# Writes a header that holds the scene's template as a raw string literal.
file(READ ${TEMPLATE} content)
file(WRITE ${OUTPUT} "#pragma once

#include <string_view>

namespace vibrotrough::view {

/// postprocess/view_case.py
inline constexpr std::string_view scene_template = R\"scene(${content})scene\";

}  // namespace vibrotrough::view
")
