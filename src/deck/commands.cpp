#include "deck/commands.hpp"

#include "core/atomic_file.hpp"
#include "core/hash.hpp"

#include <algorithm>
#include <array>

namespace vibrotrough::deck {
namespace {

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

/// Whether a character ends what can be copied as it stands.
bool is_special(char c) {
    static constexpr std::array<bool, 256> special = [] {
        std::array<bool, 256> table{};
        for (char const one : std::string_view(" \t\r#\"'")) table[static_cast<unsigned char>(one)] = true;
        return table;
    }();
    return special[static_cast<unsigned char>(c)];
}

/// Older versions wrote frames without the spin of the grains. What a frame says of a grain is not part
/// of what the engine simulates, so that a case keeps its id, and a run its checkpoint.
std::size_t length_without_spin(std::string_view command) {
    constexpr std::string_view begin = "dump frames all custom ", end = " omegax omegay omegaz";
    bool const has_spin = command.starts_with(begin) && command.ends_with(end);
    return command.size() - (has_spin ? end.size() : 0);
}

/// Appends one line without its comment, with single blanks between words.
void append_command(std::string& commands, std::string_view line) {
    std::size_t const start = commands.size();
    while (!line.empty()) {
        // Words, with the single blanks between them.
        std::size_t plain = 0;
        while (plain < line.size() &&
               (!is_special(line[plain]) ||
                (plain > 0 && line[plain] == ' ' && plain + 1 < line.size() && !is_special(line[plain + 1]))))
            ++plain;
        commands += line.substr(0, plain);
        line.remove_prefix(plain);
        if (line.empty() || line.front() == '#') break;
        std::size_t length = 1;
        if (is_blank(line.front())) {
            while (length < line.size() && is_blank(line[length])) ++length;
            if (commands.size() > start && commands.back() != ' ') commands += ' ';
        } else {
            // A text in quotes, up to the end of the line when it is not closed.
            std::size_t const close = line.find(line.front(), 1);
            length = close == std::string_view::npos ? line.size() : close + 1;
            commands += line.substr(0, length);
        }
        line.remove_prefix(length);
    }
    while (commands.size() > start && commands.back() == ' ') commands.pop_back();
    commands.resize(start + length_without_spin(std::string_view(commands).substr(start)));
}

bool is_deck(std::string_view name) {
    return name.ends_with(".liggghts") || name.ends_with(".in");
}

}  // namespace

std::string commands_of(std::string_view deck) {
    std::string commands;
    commands.reserve(deck.size() + 1);
    bool goes_on = false;
    while (!deck.empty()) {
        std::size_t const length = std::min(deck.find('\n'), deck.size());
        std::size_t const start = commands.size();
        append_command(commands, deck.substr(0, length));
        deck.remove_prefix(std::min(length + 1, deck.size()));
        bool const empty = commands.size() == start;
        if (empty && !goes_on) continue;
        goes_on = !empty && commands.back() == '&';
        if (goes_on) {
            commands.back() = ' ';
        } else {
            commands += '\n';
        }
    }
    return commands;
}

std::string digest_of_commands(std::map<std::string, std::string> const& files) {
    core::Sha256 digest;
    for (auto const& [name, content] : files) {
        digest.add(name);
        digest.add("\n");
        if (is_deck(name)) {
            digest.add(commands_of(content));
        } else {
            digest.add(content);
        }
        digest.add("\n");
    }
    return digest.hex();
}

std::map<std::string, std::string> read_files(std::filesystem::path const& folder,
                                              std::map<std::string, std::string> const& names) {
    std::map<std::string, std::string> files;
    for (auto const& [name, unused] : names) {
        std::error_code missing;
        if (!std::filesystem::is_regular_file(folder / name, missing)) continue;
        files[name] = name == control_file ? control_go_on
                                           : for_one_rank(core::read_file(folder / name, core::largest_note));
    }
    return files;
}

}  // namespace vibrotrough::deck
