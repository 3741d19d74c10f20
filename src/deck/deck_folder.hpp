#pragma once

#include "deck/deck.hpp"

#include <filesystem>
#include <map>
#include <string>

namespace vibrotrough::deck {

/// Writes the files of a case that a person will run by hand. No file is replaced.
/// @param folder  of the case; it is made
/// @param files   contents by path below the folder
/// @throws core::InputError when a file is there already with another content; nothing is written then
/// @throws core::MissingError when something cannot be written
void write_case(std::filesystem::path const& folder, std::map<std::string, std::string> const& files);

/// Makes the folder to which the engine writes frames, if the deck asks for them: the engine makes no folder.
/// @throws core::MissingError when it cannot be made
void make_frame_folder(Deck const& deck, std::filesystem::path const& folder);

}  // namespace vibrotrough::deck
