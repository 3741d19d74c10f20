# Writes a header with the files that `vibrotrough init` copies, as raw string literals by name.
set(entries "")
set(count 0)
foreach(path IN LISTS CAMPAIGNS)
    get_filename_component(name ${path} NAME)
    file(READ ${path} content)
    string(APPEND entries "    {\"${name}\", R\"campaign(${content})campaign\"},\n")
    math(EXPR count "${count} + 1")
endforeach()
file(WRITE ${OUTPUT} "#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace vibrotrough::app {

/// The files of input_templates/campaigns by name, as they were when the program was built.
inline constexpr std::array<std::pair<std::string_view, std::string_view>, ${count}> campaign_templates{{
${entries}}};

}  // namespace vibrotrough::app
")
