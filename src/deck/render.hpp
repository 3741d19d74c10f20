#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::deck {

using TemplateValues = std::map<std::string, std::string>;

/// Renders the input template of that name (e.g. "probes/impact") with these values; `lists` repeat their
/// section once per element. Other templates are its partials, by their names.
/// @throws std::logic_error when the template is malformed, std::out_of_range when there is none
std::string render_template(std::string_view name, TemplateValues const& values,
                            std::map<std::string, std::vector<TemplateValues>> const& lists = {});

}  // namespace vibrotrough::deck
