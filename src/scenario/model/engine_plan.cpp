#include "scenario/model/engine_plan.hpp"

#include "core/text.hpp"
#include "scenario/model/run_settings.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::scenario {
namespace {

constexpr std::size_t longest_line = 1000;  // the engine's own limit is 2048 after it has replaced variables

std::string_view without_blanks(std::string_view line) {
    std::size_t const first = line.find_first_not_of(" \t");
    if (first == line.npos) return {};
    return line.substr(first, line.find_last_not_of(" \t") - first + 1);
}

/// The first two words of a command.
std::array<std::string_view, 2> first_words(std::string_view command) {
    std::array<std::string_view, 2> words;
    for (std::string_view& word : words) {
        command = without_blanks(command);
        word = command.substr(0, command.find_first_of(" \t"));
        command.remove_prefix(word.size());
    }
    return words;
}

/// Takes the next word of a command from its front: up to a blank or, when it begins with one, to the next
/// quotation mark.
std::string_view take_word(std::string_view& command) {
    command = without_blanks(command);
    std::string_view word;
    if (!command.empty() && (command.front() == '"' || command.front() == '\'')) {
        std::size_t const end = std::min(command.find(command.front(), 1), command.size());
        word = command.substr(1, end - 1);
        command.remove_prefix(std::min(end + 1, command.size()));
    } else {
        word = command.substr(0, command.find_first_of(" \t"));
        command.remove_prefix(word.size());
    }
    return word;
}

/// A command without the comment behind it. In quotation marks '#' begins none.
std::string_view without_comment(std::string_view line) {
    char quote = '\0';
    for (std::size_t i = 0; i < line.size(); ++i) {
        char const c = line[i];
        if (quote != '\0') {
            if (c == quote) quote = '\0';
        } else if (c == '"' || c == '\'') {
            quote = c;
        } else if (c == '#') {
            return line.substr(0, i);
        }
    }
    return line;
}

/// Whether a word names a file outside of the deck's folder. A slash before a digit, a bracket or a variable
/// is a division.
bool leads_outside(std::string_view word) {
    auto const is_letter = [](char c) {
        return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '.';
    };
    if (word.starts_with("~/") || word == ".." || word.starts_with("../") || word.ends_with("/.."))
        return true;
    return (word.size() > 1 && word.front() == '/' && is_letter(word[1])) || word.find("/../") != word.npos;
}

/// The same of a command, of the commands in its quotation marks, and of what it prints.
std::string outside_path_of(std::string_view command, int level) {
    std::string_view const name = first_words(command)[0];
    for (int number = 0; !without_blanks(command).empty(); ++number) {
        std::string_view const word = take_word(command);
        if (name == "print" && number == 1) continue;  // what is printed
        if (leads_outside(word)) return std::string(word);
        if (level < 3 && word.find_first_of(" \t") != word.npos) {
            if (auto inner = outside_path_of(word, level + 1); !inner.empty()) return inner;
        }
    }
    return {};
}

/// Commands that would bring in what is not part of the case's id, or would end, repeat or shift the cycles.
/// This finds mistakes; it is not a protection against somebody who wants to do harm.
void check_command(std::string_view command, int line) {
    static std::set<std::string_view> const refused{
        "include", "clear", "quit", "run", "rerun", "minimize", "reset_timestep", "read_restart", "timestep"};
    auto const [name, argument] = first_words(command);
    if (!refused.contains(name) && !(name == "jump" && argument != "SELF")) return;
    throw std::invalid_argument(fmt::format(
        "line {}: '{}' is not allowed, because the deck itself reads files and counts steps and cycles", line,
        name));
}

void check_line(std::string_view text, int line) {
    if (text.size() > longest_line || core::harmless(text) != text) {
        throw std::invalid_argument(
            fmt::format("line {}: a line has at most {} printable characters", line, longest_line));
    }
}

std::string* place_of(ExtraLines& extra, std::string_view heading) {
    if (heading == "[after-contact]") return &extra.after_contact;
    if (heading == "[before-first-cycle]") return &extra.before_first_cycle;
    if (heading == "[at-cycle-end]") return &extra.at_cycle_end;
    return nullptr;
}

constexpr char const* headings = "[after-contact], [before-first-cycle] or [at-cycle-end]";

/// Adds one line to its place. @return the place of the lines that follow
std::string* add_line(ExtraLines& extra, std::string* place, std::string_view text, int line) {
    std::string_view const command = without_blanks(text);
    if (command.empty()) return place;
    check_line(command, line);
    if (command.starts_with('[')) {
        std::string* const next = place_of(extra, command);
        if (next == nullptr)
            throw std::invalid_argument(fmt::format("line {}: '{}' is not {}", line, command, headings));
        return next;
    }
    if (command.starts_with('#')) return place;
    if (place == nullptr)
        throw std::invalid_argument(
            fmt::format("line {}: a command stands above the first {}", line, headings));
    if (command.ends_with('&'))
        throw std::invalid_argument(fmt::format("line {}: a command must be written on one line", line));
    check_command(command, line);
    *place += std::string(command) + "\n";
    return place;
}

}  // namespace

std::string_view name_of(ContactModel model) {
    constexpr std::array<std::string_view, 2> names{"hertz", "hooke"};
    return names.at(static_cast<std::size_t>(model));
}

std::shared_ptr<ExtraLines const> read_extra_lines(NamedFile file) {
    ExtraLines extra{std::move(file), {}, {}, {}};
    std::string_view rest = extra.file.content;
    std::string* place = nullptr;
    for (int line = 1; !rest.empty(); ++line) {
        std::size_t const length = std::min(rest.find('\n'), rest.size());
        std::string text(rest.substr(0, length));
        rest.remove_prefix(std::min(length + 1, rest.size()));
        std::ranges::replace_if(
            text, [](char c) { return c == '\t' || c == '\r'; }, ' ');
        place = add_line(extra, place, text, line);
    }
    if (extra.after_contact.empty() && extra.before_first_cycle.empty() && extra.at_cycle_end.empty())
        throw std::invalid_argument(fmt::format("there is no command below {}", headings));
    return std::make_shared<ExtraLines const>(std::move(extra));
}

std::string outside_path(std::string_view commands) {
    while (!commands.empty()) {
        std::string_view line = commands.substr(0, commands.find('\n'));
        commands.remove_prefix(std::min(line.size() + 1, commands.size()));
        line = without_blanks(without_comment(line.substr(0, line.find('\r'))));
        if (auto found = outside_path_of(line, 0); !found.empty()) return found;
    }
    return {};
}

bool is_template_name(std::string_view name) {
    constexpr std::string_view ending = ".mustache";
    return is_plain_text(name) && name.size() > ending.size() && name.size() <= 100 &&
           name.ends_with(ending) && name.front() != '.' && name.front() != '-';
}

std::string not_covered(EnginePlan const& plan) {
    std::vector<std::string> parts;
    if (plan.contact != ContactModel::hertz)
        parts.push_back(fmt::format("contact {}", name_of(plan.contact)));
    if (plan.cohesion > 0) parts.emplace_back("cohesion sjkr");
    if (plan.extra) parts.push_back(fmt::format("lines of {}", plan.extra->file.name));
    if (plan.templates) {
        for (NamedFile const& file : plan.templates->files) parts.push_back("template " + file.name);
    }
    return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace vibrotrough::scenario
