#pragma once

#include "scenario/model/scenario.hpp"

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace vibrotrough::app {

/// Declares the flag --allow-extra.
void add_allow_extra(CLI::App& command, bool& allowed);

/// Templates hold commands of the engine, which can start programs, and a campaign file may come from
/// elsewhere.
/// @param file  names the campaign in errors
/// @throws core::InputError unless the user has allowed them
void check_extra_lines(std::string const& file, std::vector<scenario::Scenario> const& cases, bool allowed);

/// Says on standard error what the engine's certificate does not cover in these cases, if anything.
void tell_not_covered(std::vector<scenario::Scenario> const& cases);

/// Declares the option --templates.
void add_templates(CLI::App& command, std::string& folder);

/// Takes the templates of a folder for all cases, in place of the program's own that have their names.
/// @param folder  with files such as contact.mustache; empty: nothing is done
/// @throws core::InputError when it holds no template or one that the program does not have, or when the
/// campaign names templates itself
/// @throws core::MissingError when a file cannot be read
void use_templates(std::string const& folder, std::vector<scenario::Scenario>& cases);

}  // namespace vibrotrough::app
