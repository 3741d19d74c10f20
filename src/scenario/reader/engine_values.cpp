#include "core/text.hpp"
#include "scenario/reader/given_values.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

std::shared_ptr<ExtraLines const> extra_lines(GivenValues const& given) {
    std::string const name = given.word("engine.extra");
    if (name == "none") return nullptr;
    auto& known = given.files_read().extras[name];
    try {
        if (!known) known = read_extra_lines(given.named_file("engine.extra"));
    } catch (std::invalid_argument const& error) {
        given.fail("engine.extra", fmt::format("{}: {}", name, error.what()),
                   "write one command of LIGGGHTS per line below a line [after-contact], "
                   "[before-first-cycle] or [at-cycle-end]");
    }
    return known;
}

std::shared_ptr<DeckTemplates const> deck_templates(GivenValues const& given) {
    Value const* const value = given.find("engine.templates");
    if (value == nullptr) return nullptr;
    std::vector<std::string> names = value->words();
    std::ranges::sort(names);
    auto& known = given.files_read().templates[names];
    if (known) return known;
    DeckTemplates templates;
    for (std::string const& name : names) {
        if (!is_template_name(name) || std::ranges::count(names, name) > 1)
            given.fail("engine.templates",
                       fmt::format("'{}' is not the name of a template, or is listed twice",
                                   core::printable(name, 60)),
                       "write names without a path, such as \"contact.mustache\"");
        templates.files.push_back(given.named_file("engine.templates", name));
    }
    known = std::make_shared<DeckTemplates const>(std::move(templates));
    return known;
}

}  // namespace

EnginePlan read_engine_plan(GivenValues const& given) {
    EnginePlan plan;
    if (given.word("engine.contact") == "hooke") plan.contact = ContactModel::hooke;
    plan.cohesion = given.number("engine.cohesion");
    plan.extra = extra_lines(given);
    plan.templates = deck_templates(given);
    bool const block = given.find("layer.block") != nullptr;
    if (block && plan.contact != ContactModel::hertz)
        given.fail("engine.contact", "a block has a contact of its own", "remove contact or block");
    if (block && plan.cohesion > 0)
        given.fail("engine.cohesion", "a block has a contact of its own, without attraction",
                   "remove cohesion or block");
    return plan;
}

}  // namespace vibrotrough::scenario
