#include "app/command_pages.hpp"
#include "app/commands/command.hpp"

namespace vibrotrough::app {

void add_manual(CLI::App& program, int& exit_code) {
    CLI::App* const command =
        program.add_subcommand("manual", "Print all commands with their options and help");
    command->add_flag("--markdown")
        ->description("In Markdown, for the reference of the manual; there is no other form");
    command->footer("Example:\n  vibrotrough manual | less");
    command->callback([&program, &exit_code] {
        fmt::print("{}", command_reference(program));
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
