#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vibrotrough::core {

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
    friend class Template;
    struct Entry;
    std::vector<Entry> entries_;  ///< in the order in which they were set; the last one of a name counts
};

/// The characters that begin and end a tag, without spaces and equals signs.
struct TemplateTags {
    std::string_view begin = "{{";  ///< before the name
    std::string_view end = "}}";    ///< after the name
};

/// A mustache template, parsed once. Texts are inserted unchanged: nothing is escaped for HTML, so `{{name}}`
/// and
/// `{{{name}}}` are the same. A tag whose name has no data is replaced by an empty text.
class Template {
  public:
    /// @throws std::logic_error when the text is malformed, for example when a section is not closed
    explicit Template(std::string_view text, TemplateTags tags = {});
    ~Template();
    Template(Template&& other) noexcept;  ///< `other` may only be destroyed then.

    /// The text with `data` in its tags. Several threads must not call it on the same object at once. It
    /// takes a tenth of the time when the last data had the same names, switches and lengths of lists in the
    /// same order, as from case to case of a campaign: only the texts are then filled in.
    std::string render(TemplateData const& data) const;

  private:
    struct Impl;
    struct Value;
    class Form;
    using Values = std::vector<Value>;
    static void list_values(TemplateData const& data, Values& values);

    std::unique_ptr<Impl> impl_;
};

/// Texts of templates by name.
using TemplateTexts = std::map<std::string_view, std::string_view>;

/// The template of that name, in which the tags `{{> name}}` are replaced by the templates that they name. It
/// is parsed at its first use in each thread and kept, because a campaign of ten thousand cases renders the
/// same templates for each case.
/// @param texts  must live as long as the program
/// @throws std::out_of_range when there is no such template or part
/// @throws std::logic_error when it is malformed or includes itself
Template const& parsed_template(TemplateTexts const& texts, std::string_view name);

}  // namespace vibrotrough::core
