#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <kainjow/mustache.hpp>

namespace vibrotrough::core {

/// The characters that begin and end a tag, without spaces and equals signs.
struct TemplateTags {
    std::string_view begin = "{{";  ///< before the name
    std::string_view end = "}}";    ///< after the name
};

/// The data of a template: set(name, value) with a text, with a switch for a section, or with a list
/// (std::vector<TemplateData>) for a section that is repeated, in which the names of the element take
/// precedence over the names outside.
using TemplateData = kainjow::mustache::data;

/// A mustache template with data in its tags. Texts are inserted unchanged: nothing is escaped for HTML, so
/// `{{name}}` and `{{{name}}}` are the same. A tag whose name has no data is replaced by an empty text.
/// @throws std::logic_error when the template is malformed, for example when a section is not closed
std::string render(std::string_view text, TemplateData const& data, TemplateTags tags = {});

/// Texts of templates by name.
using TemplateTexts = std::map<std::string, std::string, std::less<>>;

/// The template of that name, in which the tags `{{> name}}` are replaced by the templates that they name,
/// with data in its other tags.
/// @throws std::out_of_range when there is no such template or part
/// @throws std::logic_error when it is malformed or includes itself
std::string render(TemplateTexts const& texts, std::string_view name, TemplateData const& data);

}  // namespace vibrotrough::core
