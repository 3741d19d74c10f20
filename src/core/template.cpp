#include "core/template.hpp"

#include <stdexcept>

#include <fmt/format.h>

namespace vibrotrough::core {

std::string render(std::string_view text, TemplateData const& data, TemplateTags tags) {
    TemplateTags const usual;
    bool const has_other_tags = tags.begin != usual.begin || tags.end != usual.end;
    std::string const first =
        has_other_tags ? fmt::format("{}={} {}={}", usual.begin, tags.begin, tags.end, usual.end) : "";
    kainjow::mustache::mustache parsed(first + std::string(text));
    parsed.set_custom_escape([](std::string const& value) { return value; });
    std::string rendered = parsed.render(data);
    if (!parsed.is_valid()) throw std::logic_error("template: " + parsed.error_message());
    return rendered;
}

namespace {

/// The text of a template in which each tag {{> name}} is replaced by the template of that name.
std::string with_parts(TemplateTexts const& texts, std::string_view name, int depth = 0) {
    constexpr std::string_view begin = "{{> ", end = "}}";
    constexpr int deepest = 20;
    if (depth > deepest) throw std::logic_error(fmt::format("template {}: it includes itself", name));
    auto const found = texts.find(name);
    if (found == texts.end()) throw std::out_of_range(fmt::format("there is no template {}", name));
    std::string text = found->second;
    for (std::size_t start = 0; (start = text.find(begin, start)) != std::string::npos;) {
        std::size_t const stop = text.find(end, start);
        if (stop == std::string::npos)
            throw std::logic_error(fmt::format("template {}: a tag is not closed", name));
        std::size_t const from = start + begin.size();
        std::string const part =
            with_parts(texts, std::string_view(text).substr(from, stop - from), depth + 1);
        text.replace(start, stop + end.size() - start, part);
        start += part.size();
    }
    return text;
}

}  // namespace

std::string render(TemplateTexts const& texts, std::string_view name, TemplateData const& data) {
    return render(with_parts(texts, name), data);
}

}  // namespace vibrotrough::core
