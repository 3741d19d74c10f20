#pragma once

#include <string_view>

namespace vibrotrough::app {

/// The whole program: reads the command line, runs the command, and says in one line what went wrong.
/// @param program_with_vtk  see continue_with_vtk()
/// @return the exit code (exit_code.hpp)
int run_program(std::string_view program_with_vtk, int argc, char** argv);

}  // namespace vibrotrough::app
