#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vibrotrough::store {

// Each HDF5 file of this program is followed by a line with the SHA-256 of all bytes before it. HDF5's
// readers ignore that line. Ours check it, because HDF5 may crash on a damaged file, and because damaged
// numbers must not be believed.

/// The HDF5 file with its line.
std::string with_digest(std::string hdf5_file);

/// The SHA-256 that the last line states, 64 hexadecimal digits, whether or not it is right. None when there
/// is no such line.
std::optional<std::string> stated_digest(std::string_view bytes);

/// The stated SHA-256 if it is that of the bytes before the line.
std::optional<std::string> sound_digest(std::string_view bytes);

/// The bytes before the line of a file that has one.
std::string_view without_digest(std::string_view bytes);

}  // namespace vibrotrough::store
