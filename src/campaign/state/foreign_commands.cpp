#include "campaign/state/foreign_commands.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

namespace vibrotrough::campaign {
namespace {

/// All lines in one, as a message shows them.
std::string in_one_line(scenario::ExtraLines const& extra) {
    std::string text = extra.after_contact + extra.before_first_cycle + extra.at_cycle_end;
    text.pop_back();
    for (std::size_t at = text.find('\n'); at != text.npos; at = text.find('\n', at))
        text.replace(at, 1, " ; ");
    return text;
}

bool are_equal(scenario::DeckTemplates const& some, scenario::DeckTemplates const* others) {
    return others != nullptr &&
           std::ranges::equal(some.files, others->files, [](auto const& a, auto const& b) {
               return a.name == b.name && a.content == b.content;
           });
}

/// A file that a command names by its path is not part of the case: when it changes, a case would keep its id
/// and stay finished, and nobody would know which file it was simulated with.
void refuse_outside_paths(std::string const& source, scenario::EnginePlan const& plan) {
    std::vector<scenario::NamedFile const*> files;
    if (plan.extra) files.push_back(&plan.extra->file);
    if (plan.templates) {
        for (scenario::NamedFile const& file : plan.templates->files) files.push_back(&file);
    }
    for (scenario::NamedFile const* const file : files) {
        std::string const path = scenario::outside_path(file->content);
        if (path.empty()) continue;
        throw core::InputError(fmt::format(
            "{}: a command in {} names '{}', which leads out of the deck's folder; what lies there "
            "is not part of the case, and a case would stay finished when it changes; write "
            "commands and numbers into {} itself",
            source, file->name, path, file->name));
    }
}

}  // namespace

void check_foreign_commands(std::string const& source, scenario::Scenario const& scenario,
                            ForeignCommands const& leave) {
    refuse_outside_paths(source, scenario.engine);
    if (leave.allowed) return;
    if (scenario.engine.templates && !are_equal(*scenario.engine.templates, leave.templates.get())) {
        throw core::InputError(
            fmt::format("{}: the decks would be made from {} templates beside it, which can hold any "
                        "commands; if they are what you want, call the command again with --allow-extra",
                        source, scenario.engine.templates->files.size()));
    }
    if (scenario.engine.extra) {
        throw core::InputError(
            fmt::format("{}: the engine would run these lines of {}: {}; if they are what you want, call the "
                        "command again with --allow-extra",
                        source, scenario.engine.extra->file.name, in_one_line(*scenario.engine.extra)));
    }
}

}  // namespace vibrotrough::campaign
