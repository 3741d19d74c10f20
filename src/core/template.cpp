#include "core/template.hpp"

#include <algorithm>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <kainjow/mustache.hpp>

namespace vibrotrough::core {

namespace mustache = kainjow::mustache;

struct TemplateData::Entry {
    std::string name;
    std::variant<std::string, bool, std::vector<TemplateData>> value;
};

TemplateData::TemplateData() = default;
TemplateData::TemplateData(TemplateData const& other) = default;
TemplateData::TemplateData(TemplateData&& other) noexcept = default;
TemplateData& TemplateData::operator=(TemplateData other) noexcept {
    entries_.swap(other.entries_);
    return *this;
}
TemplateData::~TemplateData() = default;

void TemplateData::set(std::string name, std::string text) {
    entries_.push_back({std::move(name), std::move(text)});
}

void TemplateData::set(std::string name, bool shown) {
    entries_.push_back({std::move(name), shown});
}

void TemplateData::set(std::string name, std::vector<TemplateData> list) {
    entries_.push_back({std::move(name), std::move(list)});
}

/// One value of the data; the entries of a list's elements follow it.
struct Template::Value {
    enum class Kind { text, blank, shown, hidden, list, element };

    std::string_view name;
    Kind kind;
    std::string_view text = {};  ///< of a text, also of a blank one
    std::size_t size = 0;        ///< of a list or an element
};

/// A text in which all values but the texts are filled in already: what stays the same while only texts
/// change. Blank texts count as well, because a line with nothing but them and the tags of sections is left
/// out.
class Template::Form {
  public:
    /// @param text  the rendered template with mark, number, mark in place of the values that are texts
    Form(Values const& values, std::string const& text) {
        for (Value const& value : values) {
            std::string const blank(value.kind == Value::Kind::blank ? value.text : "");
            features_.push_back({std::string(value.name), blank, value.kind, value.size});
        }
        for (std::size_t start = 0;;) {
            std::size_t const begin = text.find(mark, start);
            literal_.append(text, start, begin - start);
            if (begin == std::string::npos) break;
            std::size_t const end = text.find(mark, begin + 1);
            places_.push_back({literal_.size(), std::stoul(text.substr(begin + 1, end - begin - 1))});
            start = end + 1;
        }
    }

    bool fits(Values const& values) const {
        return std::equal(features_.begin(), features_.end(), values.begin(), values.end(),
                          [](Feature const& feature, Value const& value) {
                              return feature.kind == value.kind && feature.size == value.size &&
                                     feature.name == value.name &&
                                     (value.kind != Value::Kind::blank || feature.blank == value.text);
                          });
    }

    std::string filled(Values const& values) const {
        std::size_t size = literal_.size();
        for (Place const& place : places_) size += values[place.value].text.size();
        std::string text;
        text.reserve(size);
        std::size_t start = 0;
        for (Place const& place : places_) {
            text.append(literal_, start, place.at - start).append(values[place.value].text);
            start = place.at;
        }
        return text.append(literal_, start);
    }

    static constexpr char mark = '\x1e';  ///< a character that templates do not contain

  private:
    struct Feature {
        std::string name, blank;
        Value::Kind kind;
        std::size_t size;
    };
    struct Place {
        std::size_t at, value;
    };

    std::vector<Feature> features_;
    std::string literal_;
    std::vector<Place> places_;  ///< where the texts stand in the literal text
};

void Template::list_values(TemplateData const& data, Values& values) {
    for (TemplateData::Entry const& entry : data.entries_) {
        if (auto const* text = std::get_if<std::string>(&entry.value)) {
            bool const blank = text->find_first_not_of(" \t") == std::string::npos;
            values.push_back({entry.name, blank ? Value::Kind::blank : Value::Kind::text, *text});
        } else if (auto const* shown = std::get_if<bool>(&entry.value)) {
            values.push_back({entry.name, *shown ? Value::Kind::shown : Value::Kind::hidden});
        } else {
            auto const& list = std::get<std::vector<TemplateData>>(entry.value);
            values.push_back({entry.name, Value::Kind::list, {}, list.size()});
            for (TemplateData const& element : list) {
                values.push_back({{}, Value::Kind::element, {}, element.entries_.size()});
                list_values(element, values);
            }
        }
    }
}

namespace {

/// Whether only names decide what a tag does. A partial tag whose name has data would insert a value as a
/// template, and a tag may change what tags look like.
bool is_simple(std::string_view text, char mark) {
    constexpr std::string_view begin = "{{", blanks = " \t\r\n\v\f";
    if (text.find(mark) != std::string_view::npos) return false;
    for (std::size_t at = 0; (at = text.find(begin, at)) != std::string_view::npos;) {
        at += begin.size();
        std::size_t const first = text.find_first_not_of(blanks, at);
        if (first != std::string_view::npos && (text[first] == '>' || text[first] == '=')) return false;
    }
    return true;
}

}  // namespace

struct Template::Impl {
    static constexpr std::size_t most_forms = 8;

    mustache::mustache parsed;
    bool simple;
    std::vector<Form> forms = {};  // of the last kinds of data
    std::size_t oldest = 0;
    Values values = {};  // memory

    std::string render(mustache::data const& data) {
        std::string text = parsed.render(data);
        if (!parsed.is_valid()) throw std::logic_error("template: " + parsed.error_message());
        return text;
    }

    Form const& form_for(TemplateData const& data) {
        for (Form const& form : forms) {
            if (form.fits(values)) return form;
        }
        std::size_t number = 0;
        Form made(values, render(converted(data, &number)));
        if (forms.size() < most_forms) {
            forms.push_back(std::move(made));
            return forms.back();
        }
        oldest = (oldest + 1) % most_forms;
        return forms[oldest] = std::move(made);
    }

    /// @param number  counts the values in the order of list_values(), and texts become their marked numbers;
    ///                nullptr: they stay as they are
    static mustache::data converted(TemplateData const& data, std::size_t* number) {
        mustache::data object{mustache::data::type::object};
        for (TemplateData::Entry const& entry : data.entries_) {
            std::size_t const mine = number == nullptr ? 0 : (*number)++;
            if (auto const* text = std::get_if<std::string>(&entry.value)) {
                bool const blank = text->find_first_not_of(" \t") == std::string::npos;
                bool const stays = number == nullptr || blank;
                object.set(entry.name, stays ? *text : fmt::format("{0}{1}{0}", Form::mark, mine));
            } else if (auto const* shown = std::get_if<bool>(&entry.value)) {
                object.set(entry.name, *shown);
            } else {
                mustache::list elements;
                for (TemplateData const& element : std::get<std::vector<TemplateData>>(entry.value)) {
                    if (number != nullptr) ++*number;
                    elements.push_back(converted(element, number));
                }
                object.set(entry.name, elements);
            }
        }
        return object;
    }
};

Template::Template(std::string_view text, TemplateTags tags) {
    TemplateTags const usual;
    bool const other_tags = std::tie(tags.begin, tags.end) != std::tie(usual.begin, usual.end);
    std::string const whole =
        other_tags ? fmt::format("{}={} {}={}{}", usual.begin, tags.begin, tags.end, usual.end, text)
                   : std::string(text);
    impl_ = std::make_unique<Impl>(Impl{mustache::mustache(whole), is_simple(whole, Form::mark)});
    if (!impl_->parsed.is_valid()) throw std::logic_error("template: " + impl_->parsed.error_message());
    impl_->parsed.set_custom_escape([](std::string const& value) { return value; });
}

Template::~Template() = default;
Template::Template(Template&& other) noexcept = default;

std::string Template::render(TemplateData const& data) const {
    if (!impl_->simple) return impl_->render(Impl::converted(data, nullptr));
    impl_->values.clear();
    list_values(data, impl_->values);
    return impl_->form_for(data).filled(impl_->values);
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
