#pragma once

#include <filesystem>
#include <string_view>

namespace vibrotrough::campaign {

// What the program and the engine write into the folder of a packing, or of a settled packing, by list. Only
// this is removed when a packing is repeated: whatever else lies there belongs to a person.

/// Whether a file of this name in such a folder is the program's or the engine's.
bool is_run_file(std::string_view name);

/// The same in the folder dump of a packing.
bool is_frame_file(std::string_view name);

/// Removes these files, and the folder dump if nothing is left in it. A symbolic link of such a name is
/// removed, what it leads to stays. @throws core::MissingError when one cannot be removed
void remove_run_files(std::filesystem::path const& folder);

/// Renames `made` to `place`, whose files of an earlier run are removed before. What a person has put into
/// `place` stays there, beside the files of `made`; `last` is then the last that comes.
/// @throws core::MissingError when the disk refuses
void replace_run(std::filesystem::path const& made, std::filesystem::path const& place,
                 std::string_view last);

}  // namespace vibrotrough::campaign
