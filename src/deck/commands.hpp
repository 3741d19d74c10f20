#pragma once

#include "deck/deck.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace vibrotrough::deck {

/// What the engine does with a deck: its commands, one per line, without comments, blank lines, and the
/// blanks that only align words. A line that ends in & goes on in the next. A # within quotes belongs to its
/// text. Two decks with the same commands are the same run.
std::string commands_of(std::string_view deck);

/// SHA-256 over names and commands of the files of a deck (meshes count as they are).
std::string digest_of_commands(std::map<std::string, std::string> const& files);

/// The files of one packing as an engine's folder holds them now, in the form of make_deck for one rank.
/// Files that are not there are left out.
std::map<std::string, std::string> read_files(std::filesystem::path const& folder,
                                              std::map<std::string, std::string> const& names);

}  // namespace vibrotrough::deck
