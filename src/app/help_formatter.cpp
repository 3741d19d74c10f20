#include "app/help_formatter.hpp"

#include <sstream>
#include <utility>

#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

constexpr std::size_t line_width = 100;
constexpr std::size_t description_column = 30;

/// The words of a paragraph in lines of at most `width` characters, with `indent` before all lines but the
/// first.
std::string wrapped(std::string const& paragraph, std::size_t width, std::string const& indent) {
    std::istringstream words(paragraph);
    std::string text, word;
    std::size_t used = 0;
    while (words >> word) {
        if (used > 0 && used + 1 + word.size() > width) {
            text += "\n" + indent;
            used = 0;
        }
        if (used > 0) text += ' ';
        text += word;
        used += (used > 0 ? 1 : 0) + word.size();
    }
    return text;
}

/// Joins and wraps the paragraphs of a text. Lines that begin with a space stay as they are.
std::string reflowed(std::string const& text) {
    std::istringstream lines(text);
    std::string result, paragraph, line;
    auto const end_paragraph = [&] {
        if (!paragraph.empty()) result += wrapped(paragraph, line_width, "") + "\n";
        paragraph.clear();
    };
    while (std::getline(lines, line)) {
        if (!line.empty() && line.front() != ' ') {
            paragraph += line + " ";
            continue;
        }
        end_paragraph();
        result += line + "\n";
    }
    end_paragraph();
    return result;
}

/// A name on the left and its description on the right; the description begins on the next line when the name
/// is too long.
std::string entry(std::string const& name, std::string const& description) {
    std::string const indent(description_column, ' ');
    std::string text = "  " + name;
    text +=
        text.size() < description_column ? std::string(description_column - text.size(), ' ') : "\n" + indent;
    return text + wrapped(description, line_width - description_column, indent) + "\n";
}

}  // namespace

std::string HelpFormatter::make_help(CLI::App const* command, std::string name,
                                     CLI::AppFormatMode mode) const {
    std::string help = CLI::Formatter::make_help(command, std::move(name), mode);
    for (std::size_t at = 0; (at = help.find("\n\n\n", at)) != std::string::npos;) help.erase(at, 1);
    return help;
}

std::string HelpFormatter::make_option(CLI::Option const* option, bool is_positional) const {
    return entry(make_option_name(option, is_positional) + make_option_opts(option),
                 make_option_desc(option));
}

std::string HelpFormatter::make_option_opts(CLI::Option const* option) const {
    if (option->get_type_size() == 0) return {};
    std::string text;
    if (!option->get_type_name().empty()) text += " " + option->get_type_name();
    if (!option->get_default_str().empty()) text += fmt::format(" ({})", option->get_default_str());
    return text + (option->get_required() ? " REQUIRED" : "");
}

std::string HelpFormatter::make_subcommand(CLI::App const* command) const {
    std::string const description = command->get_description();
    return entry(command->get_name(), description.substr(0, description.find("\n\n")));
}

std::string HelpFormatter::make_description(CLI::App const* command) const {
    return reflowed(command->get_description()) + "\n";
}

std::string HelpFormatter::make_footer(CLI::App const* command) const {
    // CLI11 2.3 puts a blank line before it and 2.4 does not; make_help() removes one too many.
    return "\n" + reflowed(command->get_footer());
}

}  // namespace vibrotrough::app
