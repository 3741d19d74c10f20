#include "core/template.hpp"

#include <stdexcept>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <kainjow/mustache.hpp>

namespace vibrotrough::core {

namespace mustache = kainjow::mustache;

struct TemplateData::Impl {
    mustache::data data{mustache::data::type::object};
};

TemplateData::TemplateData() : impl_(std::make_unique<Impl>()) {}
TemplateData::TemplateData(TemplateData const& other) : impl_(std::make_unique<Impl>(*other.impl_)) {}
TemplateData::TemplateData(TemplateData&& other) noexcept = default;
TemplateData& TemplateData::operator=(TemplateData other) noexcept {
    std::swap(impl_, other.impl_);
    return *this;
}
TemplateData::~TemplateData() = default;

void TemplateData::set(std::string const& name, std::string const& text) {
    impl_->data.set(name, text);
}

void TemplateData::set(std::string const& name, bool shown) {
    impl_->data.set(name, shown);
}

void TemplateData::set(std::string const& name, std::vector<TemplateData> const& list) {
    mustache::list elements;
    for (TemplateData const& element : list) elements.push_back(element.impl_->data);
    impl_->data.set(name, elements);
}

struct Template::Impl {
    mustache::mustache parsed;
};

Template::Template(std::string_view text, TemplateTags tags) {
    TemplateTags const usual;
    bool const other_tags = std::tie(tags.begin, tags.end) != std::tie(usual.begin, usual.end);
    std::string const whole =
        other_tags ? fmt::format("{}={} {}={}{}", usual.begin, tags.begin, tags.end, usual.end, text)
                   : std::string(text);
    impl_ = std::make_unique<Impl>(Impl{mustache::mustache(whole)});
    if (!impl_->parsed.is_valid()) throw std::logic_error("template: " + impl_->parsed.error_message());
    impl_->parsed.set_custom_escape([](std::string const& value) { return value; });
}

Template::~Template() = default;
Template::Template(Template&& other) noexcept = default;

std::string Template::render(TemplateData const& data) const {
    std::string text = impl_->parsed.render(data.impl_->data);
    if (!impl_->parsed.is_valid()) throw std::logic_error("template: " + impl_->parsed.error_message());
    return text;
}

namespace {

/// The text of a template in which each tag {{> name}} is replaced by the template of that name.
std::string with_parts(TemplateTexts const& texts, std::string_view name, int depth = 0) {
    constexpr std::string_view begin = "{{> ", end = "}}";
    constexpr int deepest = 20;
    if (depth > deepest) throw std::logic_error(fmt::format("template {}: it includes itself", name));
    std::string text(texts.at(name));
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

Template const& parsed_template(TemplateTexts const& texts, std::string_view name) {
    thread_local std::map<TemplateTexts const*, std::map<std::string, Template, std::less<>>> kept;
    auto& templates = kept[&texts];
    auto found = templates.find(name);
    if (found == templates.end())
        found = templates.emplace(std::string(name), Template(with_parts(texts, name))).first;
    return found->second;
}

}  // namespace vibrotrough::core
