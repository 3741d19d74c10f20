#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace vibrotrough::app {

/// Prints the help of all commands with lines of at most 100 characters.
///
/// Descriptions and footers are paragraphs with an empty line between them. The lines of a paragraph are
/// joined and broken again to fit. A line that begins with a space, such as an example, is printed as it
/// stands.
class HelpFormatter : public CLI::Formatter {
  public:
    /// The whole help of a command, without repeated empty lines.
    std::string make_help(CLI::App const* command, std::string name, CLI::AppFormatMode mode) const override;

    /// An option with its name on the left and what it does on the right.
    std::string make_option(CLI::Option const* option, bool is_positional) const override;

    /// What an option takes: the kind of its value, its default and whether it must be given.
    std::string make_option_opts(CLI::Option const* option) const override;

    /// A command in the list of its parent, with the first paragraph of its description.
    std::string make_subcommand(CLI::App const* command) const override;

    /// What the command does, above its usage.
    std::string make_description(CLI::App const* command) const override;

    /// What its output means, its exit codes and examples.
    std::string make_footer(CLI::App const* command) const override;
};

}  // namespace vibrotrough::app
