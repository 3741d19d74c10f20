#pragma once

#include "deck/deck.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace vibrotrough::deck {

/// The commands of a deck, one per line, without comments, blank lines and the blanks that only align words.
/// A line that ends in & continues on the next. A # within quotes belongs to the text. The columns with the
/// spin of the grains in the frames are left out. Two decks with the same commands make the engine do the
/// same.
std::string commands_of(std::string_view deck);

/// SHA-256 over the names and commands of a deck's files, 64 hexadecimal digits. Other files, such as meshes,
/// count with all their bytes. The id of a case contains this digest, so that rewording a comment changes no
/// id.
/// @param files  content by name, for one rank
std::string digest_of_commands(std::map<std::string, std::string> const& files);

/// The files of one packing as they are in its folder now, converted to the form of make_deck for one rank.
/// @param names  the files to read; only the names are used, and files that do not exist are left out
/// @throws core::MissingError when a file cannot be read
std::map<std::string, std::string> read_files(std::filesystem::path const& folder,
                                              std::map<std::string, std::string> const& names);

}  // namespace vibrotrough::deck
