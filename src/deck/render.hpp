#pragma once

#include "core/template.hpp"

#include <string>
#include <string_view>

namespace vibrotrough::deck {

/// Renders the input template of that name, e.g. "probes/impact". Other templates are its parts.
/// @throws std::out_of_range when there is none, std::logic_error when it is malformed
std::string render_template(std::string_view name, core::TemplateData const& data);

}  // namespace vibrotrough::deck
