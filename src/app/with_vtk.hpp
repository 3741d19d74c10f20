#pragma once

#include <string_view>

namespace vibrotrough::app {

/// Loading VTK takes longer than most commands, and only few of them need it: it is linked to a second
/// program, which lies beside this one and has the same commands. If the command line names a command that
/// writes files for ParaView, or one whose text depends on VTK (help, version, manual page, completion),
/// this process goes on as that program; else this returns.
/// @param name  file name of the second program; empty in that program itself, and in a build without VTK
/// @throws core::MissingError when files for ParaView are to be written and that program cannot be started
void continue_with_vtk(std::string_view name, int argc, char** argv);

}  // namespace vibrotrough::app
