#pragma once

#include "core/template.hpp"
#include "scenario/model/engine_plan.hpp"

#include <string>
#include <string_view>

namespace vibrotrough::deck {

/// The text of an input template with `data` in its tags.
/// @param name      path in input_templates/ without ending, e.g. "probes/impact"
/// @param replaced  templates of a case, in place of those that have their names; nullptr: none
/// @throws std::out_of_range when there is no such template
/// @throws std::logic_error when it is malformed
/// @throws core::InputError when one of the case's is malformed, or there is no template of its name
std::string render_template(std::string_view name, core::TemplateData const& data,
                            scenario::DeckTemplates const* replaced = nullptr);

/// SHA-256 of the program's templates of decks, without the lines that are comments: a part of the id of a
/// case, so that another deck is another case.
std::string const& digest_of_templates();

}  // namespace vibrotrough::deck
