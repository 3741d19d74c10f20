#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::core {

/// What a template shows: texts, yes or no, and lists, by name.
class TemplateData {
  public:
    TemplateData();
    TemplateData(TemplateData const& other);
    TemplateData(TemplateData&& other) noexcept;
    TemplateData& operator=(TemplateData other) noexcept;
    ~TemplateData();

    /// Sets a name, or sets it anew: the text in the place of {{name}}.
    void set(std::string const& name, std::string const& text);
    void set(std::string const& name, char const* text) { set(name, std::string(text)); }
    /// Whether the section {{#name}}...{{/name}} is there, and {{^name}}...{{/name}} is not.
    void set(std::string const& name, bool shown);
    /// The section {{#name}}...{{/name}} is repeated for each element, which sees its own names first.
    void set(std::string const& name, std::vector<TemplateData> const& list);

  private:
    friend class Template;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// What begins and ends a tag. Neither has spaces or an equals sign in it.
struct TemplateTags {
    std::string_view begin = "{{", end = "}}";
};

/// A mustache template, parsed once. Texts are put in as they are: nothing is escaped for HTML, so {{name}}
/// and {{{name}}} are the same. A name without data is replaced by nothing.
class Template {
  public:
    /// @throws std::logic_error when the text is malformed, such as a section that is not closed
    explicit Template(std::string_view text, TemplateTags tags = {});
    ~Template();
    Template(Template&& other) noexcept;

    /// Not for several threads at once.
    std::string render(TemplateData const& data) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Texts of templates by name.
using TemplateTexts = std::map<std::string_view, std::string_view>;

/// The template of that name, with its parts {{> name}} in their places. It is parsed at its first use in
/// each thread and kept, because a campaign of ten thousand cases renders the same templates for each case.
/// @param texts  must live as long as the program
/// @throws std::out_of_range when there is no such template or part, std::logic_error when it is malformed
Template const& parsed_template(TemplateTexts const& texts, std::string_view name);

}  // namespace vibrotrough::core
