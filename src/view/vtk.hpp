#pragma once

#include <string>

namespace vibrotrough::view {

/// Whether this program was built with VTK, which writes the files for ParaView (the CMake option
/// VIBROTROUGH_VIEW). Without it, all functions of this module that read frames or write files throw what
/// require_vtk() throws.
bool has_vtk();

/// What --version says: "VTK 9.1.0", or that there is none.
std::string vtk_name();

/// What the help of a command that writes files for ParaView says in a program without VTK; else empty.
std::string vtk_help();

/// @throws MissingError with one line when this program was built without VTK
void require_vtk();

}  // namespace vibrotrough::view
