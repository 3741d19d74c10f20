#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vibrotrough::core {

/// The characters that begin and end a tag, without spaces and equals signs.
struct TemplateTags {
    std::string_view begin = "{{";  ///< before the name
    std::string_view end = "}}";    ///< after the name
};

/// The data of a template by name: texts, switches for sections, and lists for repeated sections.
class TemplateData {
  public:
    TemplateData();                               ///< Without any name.
    TemplateData(TemplateData const& other);      ///< Copies all names with their values.
    TemplateData(TemplateData&& other) noexcept;  ///< `other` may only be assigned or destroyed then.
    TemplateData& operator=(TemplateData other) noexcept;  ///< Takes over all names with their values.
    ~TemplateData();

    /// Sets the text that replaces the tag `{{name}}`. An earlier value of the name no longer counts.
    void set(std::string name, std::string text);
    /// Sets the text that replaces the tag `{{name}}`; without this overload a literal would become a bool.
    void set(std::string name, char const* text) { set(std::move(name), std::string(text)); }
    /// Sets whether the section that begins with `{{#name}}` is rendered. The inverted section, which begins
    /// with
    /// `{{^name}}`, is rendered otherwise.
    void set(std::string name, bool shown);
    /// Repeats the section that begins with `{{#name}}` once for each element. Within it, the names of the
    /// element take precedence over the names outside.
    void set(std::string name, std::vector<TemplateData> list);

  private:
    friend std::string render(std::string_view text, TemplateData const& data, TemplateTags tags);
    struct Entry;
    struct Converter;
    std::vector<Entry> entries_;  ///< in the order in which they were set; the last one of a name counts
};

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
