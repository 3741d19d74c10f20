#pragma once

#include <string>

namespace CLI {
class App;
}

namespace vibrotrough::app {

/// The manual page of the program in the language of man(7), with all commands and options. It follows from
/// the definition of the command line, so that both always agree.
std::string manual_page(CLI::App const& program);

/// The same in Markdown, for the page src/app/commands.md: a table of all commands, then each with its
/// options and its help text.
std::string command_reference(CLI::App const& program);

/// What makes bash complete commands and options.
std::string bash_completion(CLI::App const& program);

}  // namespace vibrotrough::app
