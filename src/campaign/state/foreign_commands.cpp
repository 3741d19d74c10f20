#include "campaign/state/foreign_commands.hpp"

#include "core/error.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace vibrotrough::campaign {
namespace {

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
}

}  // namespace vibrotrough::campaign
