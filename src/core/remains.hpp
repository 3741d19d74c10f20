#pragma once

#include "core/own_folder.hpp"

#include <string>

namespace vibrotrough::core {

// A file that must appear whole is written under another name first. Whoever writes it holds a lock (flock)
// on it, so that the next writer of the same file can remove what a killed process left, whatever process
// number or machine is in its name.

/// The name of the temporary file of a file: NAME.part-MACHINE-NUMBER. The machine is needed because machines
/// that share a file system may use the same process number.
std::string temporary_name(std::string const& name);

/// Removes the temporary files of a file that killed processes left. What a person called NAME.part-mine is
/// none of them. That one cannot be removed does no harm.
void remove_remains(ParentFolder const& parent);

}  // namespace vibrotrough::core
