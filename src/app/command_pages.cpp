#include "app/command_pages.hpp"

#include "app/exit_code.hpp"

#include <algorithm>
#include <sstream>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::app {
namespace {

/// A command with its words after the program's name, e.g. {"theory", "point"}; none for the program itself.
struct Command {
    std::vector<std::string> words;
    CLI::App const* app;
};

std::vector<CLI::App const*> subcommands_of(CLI::App const& app) {
    return app.get_subcommands([](CLI::App const*) { return true; });
}

void collect(Command const& command, std::vector<Command>& all) {
    all.push_back(command);
    for (CLI::App const* const one : subcommands_of(*command.app)) {
        Command next{command.words, one};
        next.words.push_back(one->get_name());
        collect(next, all);
    }
}

std::vector<Command> commands_of(CLI::App const& program) {
    std::vector<Command> all;
    collect({{}, &program}, all);
    return all;
}

/// The ways to write an option, e.g. {"-h", "--help"}; none for a positional argument.
std::vector<std::string> spellings(CLI::Option const& option) {
    std::vector<std::string> names;
    for (std::string const& name : option.get_snames()) names.push_back("-" + name);
    for (std::string const& name : option.get_lnames()) names.push_back("--" + name);
    return names;
}

std::vector<CLI::Option const*> options_of(CLI::App const& app) {
    return app.get_options([](CLI::Option const*) { return true; });
}

/// The words that may follow a command: its subcommands and its options.
std::vector<std::string> words_after(Command const& command) {
    std::vector<std::string> words;
    for (CLI::App const* const one : subcommands_of(*command.app)) words.push_back(one->get_name());
    for (CLI::Option const* const option : options_of(*command.app)) {
        for (std::string const& name : spellings(*option)) words.push_back(name);
    }
    return words;
}

/// The first paragraph of a description, on one line.
std::string summary_of(std::string const& description) {
    std::istringstream words(description.substr(0, description.find("\n\n")));
    std::string text, word;
    while (words >> word) text += (text.empty() ? "" : " ") + word;
    return text;
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
}

/// Text for a cell of a Markdown table.
std::string as_cell(std::string text) {
    for (std::string_view const mark : {"|", "*", "<", "["})
        text = replaced(text, mark, "\\" + std::string(mark));
    return text;
}

/// The options of a command as a Markdown table, without --help, which all have; empty when there are none.
std::string options_as_table(CLI::App const& app) {
    std::string rows;
    for (CLI::Option const* const option : options_of(app)) {
        std::vector<std::string> const names = spellings(*option);
        if (std::ranges::find(names, "--help") != names.end()) continue;
        std::string name = names.empty() ? option->get_name(true) : fmt::format("{}", fmt::join(names, ", "));
        if (!names.empty() && !option->get_type_name().empty()) name += " " + option->get_type_name();
        rows += fmt::format("| `{}` | {} |\n", replaced(name, "|", "\\|"),
                            as_cell(summary_of(option->get_description())));
    }
    return rows.empty() ? "" : "\n| option | meaning |\n|---|---|\n" + rows;
}

/// A word between single quotes for bash.
std::string quoted(std::string const& text) {
    return "'" + replaced(text, "'", "'\\''") + "'";
}

}  // namespace

std::string bash_completion(CLI::App const& program) {
    std::string cases;
    for (Command const& command : commands_of(program)) {
        cases +=
            fmt::format("        {}) words={} ;;\n", quoted(fmt::format("{}", fmt::join(command.words, " "))),
                        quoted(fmt::format("{}", fmt::join(words_after(command), " "))));
    }
    return fmt::format(R"(# bash completion of vibrotrough; made by 'vibrotrough completion bash'
_vibrotrough() {{
    local current=${{COMP_WORDS[COMP_CWORD]}} path='' words='' word
    for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
        case $word in -*) break ;; esac
        case " $(_vibrotrough_words "$path") " in *" $word "*) path="${{path:+$path }}$word" ;; *) break ;; esac
    done
    words=$(_vibrotrough_words "$path")
    COMPREPLY=($(compgen -W "$words" -- "$current"))
    if [ ${{#COMPREPLY[@]}} -eq 0 ]; then
        compopt -o default 2>/dev/null   # a file or a folder
    fi
}}
_vibrotrough_words() {{
    local words=''
    case $1 in
{}    esac
    printf '%s' "$words"
}}
complete -F _vibrotrough vibrotrough
)",
                       cases);
}

std::string command_reference(CLI::App const& program) {
    std::string contents, sections;
    for (Command const& command : commands_of(program)) {
        if (command.words.empty()) continue;
        std::string const name = fmt::format("{}", fmt::join(command.words, " "));
        std::string const summary = summary_of(command.app->get_description()) + ".";
        contents += fmt::format("| [`{}`](#vibrotrough-{}) | {} |\n", name, replaced(name, " ", "-"),
                                as_cell(summary));
        sections += fmt::format("\n## vibrotrough {}\n\n{}\n{}", name, as_cell(summary),
                                options_as_table(*command.app));
        std::string const footer = command.app->get_footer();
        if (!footer.empty()) sections += "\n```text\n" + footer + "\n```\n";
    }
    return "# All commands\n\nPrinted by `vibrotrough manual --markdown`; `vibrotrough COMMAND --help` shows "
           "the same for one command.\n\n```text\n" +
           std::string(exit_codes_help) + "\n```\n\n| command | what it does |\n|---|---|\n" + contents +
           sections;
}

}  // namespace vibrotrough::app
