#include "scenario/reader/keys.hpp"

#include "app/commands.hpp"
#include "app/exit_code.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace vibrotrough::app {

void add_keys(CLI::App& program, int& exit_code) {
    CLI::App* const command =
        program.add_subcommand("keys", "Print the reference of all keys of the campaign file");
    command->footer(
        R"(Prints a Markdown table with an example, the range, the default and the meaning of each key.

Example:
  vibrotrough keys | less)");
    command->callback([&exit_code] {
        fmt::print("{}", scenario::key_reference());
        exit_code = all_well;
    });
}

}  // namespace vibrotrough::app
