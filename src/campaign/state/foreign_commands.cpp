#include "campaign/state/foreign_commands.hpp"

#include "core/error.hpp"

#include <algorithm>

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

}  // namespace

void check_foreign_commands(std::string const& source, scenario::Scenario const& scenario,
                            ForeignCommands const& leave) {
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
