#include "scenario/reader/keys.hpp"

#include "app/commands/command.hpp"
#include "scenario/reader/key_schema.hpp"

namespace vibrotrough::app {

void add_keys(CLI::App& program, int& exit_code) {
    CLI::App* const command =
        program.add_subcommand("keys", "Print the reference of all keys of the campaign file");
    auto const schema = std::make_shared<bool>(false);
    command->add_flag("--schema", *schema,
                      "Print a JSON Schema, with which editors complete and explain the keys");
    command->footer(
        R"(Prints a page in Markdown with an example, the range, the default and the meaning of each key.

Examples:
  vibrotrough keys | less
  vibrotrough keys --schema > keys.json

An editor finds the schema by the line '#:schema keys.json' at the top of the campaign file.)");
    command->callback([schema, &exit_code] {
        fmt::print("{}", *schema ? scenario::key_schema() : scenario::key_reference());
        exit_code = all_well;
    });
}

}  // namespace vibrotrough::app
