#include "deck/render.hpp"

#include "core/error.hpp"
#include "core/hash.hpp"
#include "deck/templates.hpp"

#include <deque>
#include <regex>
#include <stdexcept>

#include <fmt/format.h>

namespace vibrotrough::deck {
namespace {

/// The program's templates, with those of a case in place of the ones that have their names.
core::TemplateTexts texts_with(scenario::DeckTemplates const& replaced) {
    constexpr std::string_view ending = ".mustache";
    core::TemplateTexts texts = input_templates;
    for (scenario::NamedFile const& file : replaced.files) {
        auto const found = texts.find(file.name.substr(0, file.name.size() - ending.size()));
        if (found == texts.end())
            throw core::InputError(
                fmt::format("{}: there is no template of this name to replace; src/deck includes those of "
                            "input_templates",
                            file.name));
        found->second = file.content;
    }
    return texts;
}

/// A template without its sections `also_...`, which are only in decks whose scenario asks for them, so that
/// the ids of other cases stay.
std::string for_all_decks(std::string const& text) {
    static std::regex const section(R"(\{\{#(also_\w+)\}\}[\s\S]*?\{\{/\1\}\})"),
        tag(R"(\{\{[\^/]also_\w+\}\})");
    return std::regex_replace(std::regex_replace(text, section, ""), tag, "");
}

}  // namespace

std::string render_template(std::string_view name, core::TemplateData const& data,
                            scenario::DeckTemplates const* replaced) {
    if (replaced == nullptr) return core::render(input_templates, name, data);
    try {
        return core::render(texts_with(*replaced), name, data);
    } catch (std::logic_error const& error) {  // malformed, or a part that does not exist
        throw core::InputError(
            fmt::format("the templates of the case make no deck ({}); correct them", error.what()));
    }
}

std::string const& digest_of_templates() {
    static std::string const digest = [] {
        std::vector<std::string_view> all;
        std::deque<std::string> texts;  // a deque, so that earlier texts stay where they are
        for (auto const& [name, text] : input_templates) {
            if (name.starts_with("probes/")) continue;
            all.push_back(name);
            texts.push_back(for_all_decks(text));
            // Comments and blank lines change no deck.
            for (std::size_t start = 0; start < texts.back().size();) {
                std::size_t const end = std::min(texts.back().find('\n', start), texts.back().size() - 1) + 1;
                std::string_view const line = std::string_view(texts.back()).substr(start, end - start);
                if (line != "\n" && !line.starts_with('#')) all.push_back(line);
                start = end;
            }
        }
        return core::sha256_hex(all);
    }();
    return digest;
}

}  // namespace vibrotrough::deck
