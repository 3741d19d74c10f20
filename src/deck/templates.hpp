#pragma once

#include <map>
#include <string_view>

namespace vibrotrough::deck {

/// The files of input_templates/, by name without ".mustache", as they were when the program was built.
extern std::map<std::string_view, std::string_view> const input_templates;

}  // namespace vibrotrough::deck
