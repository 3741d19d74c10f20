# Writes a header with FILES as raw string literals by name: the array NAME, described by WHAT.
set(entries "")
set(count 0)
foreach(path IN LISTS FILES)
    get_filename_component(name ${path} NAME)
    file(READ ${path} content)
    string(APPEND entries "    {\"${name}\", R\"embedded(${content})embedded\"},\n")
    math(EXPR count "${count} + 1")
endforeach()
file(WRITE ${OUTPUT} "#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace vibrotrough::app {

/// ${WHAT}, by name, as they were when the program was built.
inline constexpr std::array<std::pair<std::string_view, std::string_view>, ${count}> ${NAME}{{
${entries}}};

}  // namespace vibrotrough::app
")
