#include "deck/render.hpp"

#include "deck/templates.hpp"

#include <stdexcept>

#include <kainjow/mustache.hpp>

namespace vibrotrough::deck {

std::string render_template(std::string_view name, TemplateValues const& values,
                            std::map<std::string, std::vector<TemplateValues>> const& lists) {
    namespace mustache = kainjow::mustache;
    mustache::data data;
    for (auto const& [partial, content] : input_templates) {
        if (partial == name) continue;
        data.set(std::string(partial),
                 mustache::partial([content = std::string(content)] { return content; }));
    }
    for (auto const& [key, value] : values) data.set(key, value);
    for (auto const& [key, elements] : lists) {
        mustache::list list;
        for (TemplateValues const& element : elements) {
            mustache::data entry;
            for (auto const& [inner, value] : element) entry.set(inner, value);
            list.push_back(entry);
        }
        data.set(key, list);
    }
    mustache::mustache deck{std::string(input_templates.at(name))};
    std::string const text = deck.render(data);
    if (!deck.is_valid()) throw std::logic_error("input_templates: " + deck.error_message());
    return text;
}

}  // namespace vibrotrough::deck
