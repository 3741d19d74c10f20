#pragma once

#include <string>

namespace vibrotrough::app {

/// What --version prints: program, commit, compiler, libraries, and the LIGGGHTS on the PATH, a line each.
/// The first line is "vibrotrough VERSION (COMMIT)".
std::string version_text();

}  // namespace vibrotrough::app
