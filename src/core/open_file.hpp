#pragma once

#include <filesystem>

namespace vibrotrough::core {

/// The kinds of files that a reader takes.
enum class Kinds {
    regular,  ///< regular files only, as in a campaign's folder, where anybody may have put anything
    given,    ///< also pipes and devices, which a person may name on the command line; the opening may wait
};

/// Opens a file for reading; every road to a file goes through here or through ParentFolder::open(). Nothing
/// is waited for unless the person gave the file.
/// @returns a descriptor for the caller to close; -1 with errno when the file cannot be opened, and -1 with
/// errno = ESPIPE when it is of another kind. Folders are opened; reading from them fails.
int open_to_read(std::filesystem::path const& path, Kinds kinds);

}  // namespace vibrotrough::core
