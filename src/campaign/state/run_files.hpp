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

}  // namespace vibrotrough::campaign
