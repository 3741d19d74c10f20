#pragma once

#include <string>

namespace CLI {
class App;
}

namespace vibrotrough::app {

/// The commands for the manual: a table of all commands, then each with its options and its help text. It
/// follows from the definition of the command line, so that both always agree.
std::string command_reference(CLI::App const& program);

/// What makes bash complete commands and options.
std::string bash_completion(CLI::App const& program);

}  // namespace vibrotrough::app
