#include "deck/commands.hpp"

#include "core/atomic_file.hpp"
#include "core/hash.hpp"

#include <algorithm>
#include <vector>

namespace vibrotrough::deck {
namespace {

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

/// One line without its comment, with single blanks between words.
std::string command_in(std::string_view line) {
    std::string command;
    while (!line.empty()) {
        std::size_t const plain = std::min(line.find_first_of(" \t\r#\"'"), line.size());
        command += line.substr(0, plain);
        line.remove_prefix(plain);
        if (line.empty() || line.front() == '#') break;
        std::size_t length = 1;
        if (is_blank(line.front())) {
            if (!command.empty() && command.back() != ' ') command += ' ';
        } else {
            // A text in quotes, up to the end of the line when it is not closed.
            std::size_t const close = line.find(line.front(), 1);
            length = close == std::string_view::npos ? line.size() : close + 1;
            command += line.substr(0, length);
        }
        line.remove_prefix(length);
    }
    while (command.ends_with(' ')) command.pop_back();
    return command;
}

/// Older versions wrote frames without the spin of the grains. What a frame says of a grain is not part
/// of what the engine simulates, so that a case keeps its id, and a run its checkpoint.
std::string without_spin(std::string command) {
    constexpr std::string_view begin = "dump frames all custom ", end = " omegax omegay omegaz";
    if (command.starts_with(begin) && command.ends_with(end)) command.resize(command.size() - end.size());
    return command;
}

bool is_deck(std::string_view name) {
    return name.ends_with(".liggghts") || name.ends_with(".in");
}

}  // namespace

std::string commands_of(std::string_view deck) {
    std::string commands;
    bool goes_on = false;
    while (!deck.empty()) {
        std::size_t const length = std::min(deck.find('\n'), deck.size());
        std::string command = without_spin(command_in(deck.substr(0, length)));
        deck.remove_prefix(std::min(length + 1, deck.size()));
        if (command.empty() && !goes_on) continue;
        goes_on = command.ends_with('&');
        if (goes_on) command.back() = ' ';
        commands += command;
        if (!goes_on) commands += '\n';
    }
    return commands;
}

std::string digest_of_commands(std::map<std::string, std::string> const& files) {
    std::vector<std::string> commands;
    commands.reserve(files.size());
    std::vector<std::string_view> pieces;
    for (auto const& [name, content] : files) {
        commands.push_back(is_deck(name) ? commands_of(content) : std::string());
        std::string_view const counted = is_deck(name) ? std::string_view(commands.back()) : content;
        pieces.insert(pieces.end(), {name, "\n", counted, "\n"});
    }
    return core::sha256_hex(pieces);
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
