#include "deck/render.hpp"

#include "core/error.hpp"
#include "core/hash.hpp"
#include "deck/templates.hpp"

#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>

#include <fmt/format.h>

namespace vibrotrough::deck {
namespace {

/// The program's templates with some of them replaced. The texts live as long as the program, as
/// core::parsed_template wants it; a campaign has one set of them.
class ReplacedTemplates {
  public:
    explicit ReplacedTemplates(scenario::DeckTemplates const& replaced) : texts_(input_templates) {
        constexpr std::string_view ending = ".mustache";
        for (scenario::NamedFile const& file : replaced.files) {
            std::string const name = file.name.substr(0, file.name.size() - ending.size());
            auto const found = texts_.find(name);
            if (found == texts_.end())
                throw core::InputError(
                    fmt::format("{}: there is no template of this name to replace; src/deck includes those "
                                "of input_templates",
                                file.name));
            contents_.push_back(std::make_unique<std::string>(file.content));
            found->second = *contents_.back();
        }
    }
    core::TemplateTexts const& texts() const { return texts_; }

  private:
    core::TemplateTexts texts_;
    std::vector<std::unique_ptr<std::string>> contents_;
};

core::TemplateTexts const& texts_with(scenario::DeckTemplates const& replaced) {
    static std::mutex access;
    static std::map<std::string, std::unique_ptr<ReplacedTemplates>> known;
    std::vector<std::string_view> pieces;
    for (scenario::NamedFile const& file : replaced.files)
        pieces.insert(pieces.end(), {file.name, "\n", file.content, "\n"});
    std::scoped_lock const lock(access);
    auto& found = known[core::sha256_hex(pieces)];
    if (!found) found = std::make_unique<ReplacedTemplates>(replaced);
    return found->texts();
}

}  // namespace

std::string render_template(std::string_view name, core::TemplateData const& data) {
    return core::parsed_template(input_templates, name).render(data);
}

std::string render_template(std::string_view name, core::TemplateData const& data,
                            scenario::DeckTemplates const* replaced) {
    if (replaced == nullptr) return render_template(name, data);
    try {
        return core::parsed_template(texts_with(*replaced), name).render(data);
    } catch (std::logic_error const& error) {  // malformed, or a part that does not exist
        throw core::InputError(
            fmt::format("the templates of the case make no deck ({}); correct them", error.what()));
    }
}

}  // namespace vibrotrough::deck
