#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vibrotrough::app {

/// Runs a script of postprocess/ with the first Python that has the modules; the script's output goes where
/// the program's goes.
/// @param python   program to use; empty: Debian's /usr/bin/python3, else python3 on the PATH
/// @param modules  that the script imports, e.g. "matplotlib"
/// @throws MissingError when there is no such Python, no such script, or the script fails (it has said why)
void run_script(std::string const& script, std::vector<std::string> const& arguments,
                std::string const& python, std::vector<std::string> const& modules);

/// As run_script, but gives the script's exit code (128 + n when signal n ended it) instead of throwing for
/// it.
int script_exit_code(std::string const& script, std::vector<std::string> const& arguments,
                     std::string const& python, std::vector<std::string> const& modules);

/// The folder of the scripts: beside an installed program, or that of the sources it was built from.
/// @throws MissingError when there is none
std::filesystem::path script_folder();

}  // namespace vibrotrough::app
