#include "app/command_pages.hpp"
#include "app/commands.hpp"
#include "app/exit_code.hpp"

#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace vibrotrough::app {

void add_manual(CLI::App& program, int& exit_code) {
    CLI::App* const command = program.add_subcommand("manual", "Print the manual page");
    auto const markdown = std::make_shared<bool>(false);
    command->add_flag("--markdown", *markdown,
                      "Print it in Markdown instead, as the page src/app/commands.md");
    command->footer(
        R"(The page is in the language of man(7) and describes all commands and options. An installed program has it already:
'man vibrotrough'.

Example:
  vibrotrough manual | man --local-file -)");
    command->callback([&program, &exit_code, markdown] {
        fmt::print("{}", *markdown ? command_reference(program) : manual_page(program));
        exit_code = all_well;
    });
}

void add_completion(CLI::App& program, int& exit_code) {
    CLI::App* const command =
        program.add_subcommand("completion", "Print what makes bash complete commands and options");
    command->add_option("SHELL", "bash")->required()->type_name("")->check(CLI::IsMember({"bash"}));
    command->footer(
        R"(An installed program brings its completion along. For one in its build folder:

Example:
  vibrotrough completion bash > ~/.local/share/bash-completion/completions/vibrotrough)");
    command->callback([&program, &exit_code] {
        fmt::print("{}", bash_completion(program));
        exit_code = all_well;
    });
}

}  // namespace vibrotrough::app
