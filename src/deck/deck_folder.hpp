#pragma once

#include "core/note.hpp"
#include "deck/deck.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace vibrotrough::deck {

/// The file beside the decks of a case that holds the digests of what was written there.
constexpr char const* written_file = "deck.json";

/// deck.json: the digests of what was written, by path below the folder.
/// @throws core::note::Fault when the text is not such a note
core::note::Digests parse_written(std::string_view text);

/// Writes the files of a case that a person will run by hand, below an OwnFolder. What an earlier call wrote
/// is replaced, but not a file that somebody else wrote or edited.
/// @param folder  of the case; it is made
/// @param files   contents by path below the folder
/// @throws core::InputError when a file would be replaced that is not what was written here; nothing is
/// written then
/// @throws core::MissingError when something cannot be written
void write_case(std::filesystem::path const& folder, std::map<std::string, std::string> const& files);

/// Makes the folder to which the engine writes frames, if the deck asks for them: the engine makes no folder.
/// @throws core::MissingError when it cannot be made
void make_frame_folder(Deck const& deck, std::filesystem::path const& folder);

}  // namespace vibrotrough::deck
