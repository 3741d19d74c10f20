#pragma once

#include "scenario/model/scenario.hpp"

#include <memory>
#include <string>

namespace vibrotrough::campaign {

/// What a person allows of that which comes with a campaign's files and can start any program: the
/// templates of the decks.
struct ForeignCommands {
    bool allowed = false;  ///< all of them
    /// Templates that the person has named on the command line, which are allowed without being asked for.
    std::shared_ptr<scenario::DeckTemplates const> templates = {};

    /// Whether it allows anything.
    bool any() const { return allowed || templates != nullptr; }
};

/// The gate to the engine: both roads to it, run_campaign() and work(), go through it with every case that
/// they may simulate, wherever it was read.
/// @param source  names the campaign in errors
/// @throws core::InputError unless they are allowed
void check_foreign_commands(std::string const& source, scenario::Scenario const& scenario,
                            ForeignCommands const& leave);

}  // namespace vibrotrough::campaign
