#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace vibrotrough::app {

/// Runs a module of postprocess/ as a script, such as "vibrotrough.report.page", with the first Python that
/// has the modules. The output of the script goes to the same places as that of this program. Python runs in
/// script_folder(), so that no module and no settings of the user's folder are loaded: paths in `arguments`
/// must be absolute.
/// @param python   path of the Python to use; empty for /usr/bin/python3, else python3 on the PATH
/// @param modules  names of the modules that the script imports, e.g. "matplotlib"
/// @throws core::MissingError when there is no such Python or script, or when the script fails (it has then
/// printed the reason)
void run_script(std::string const& script, std::vector<std::string> const& arguments,
                std::string const& python, std::vector<std::string> const& modules);

/// Runs a script as run_script() does and returns its exit code, or 128 + n when signal n ended it.
/// @throws core::MissingError when there is no such Python or script
int script_exit_code(std::string const& script, std::vector<std::string> const& arguments,
                     std::string const& python, std::vector<std::string> const& modules);

/// The folder of the scripts and of the package vibrotrough: beside the installed program, or in the sources
/// that it was built from.
/// @throws core::MissingError when there is no such folder
std::filesystem::path script_folder();

/// @throws core::MissingError when a script ended with another exit code than 0
void check_script(std::string const& script, int code);

/// Writes the page of a decision, one HTML file that needs no network and no other file, with
/// vibrotrough.report.decision.
/// @param data    what learn::design_page_data() or learn::corner_plot_data() gave
/// @param kind    "design" or "calibration"
/// @param file    to write
/// @param python  path of the Python to use; empty for the usual one
/// @throws core::MissingError when Python or one of its modules is missing, or the file cannot be written
void write_decision_page(nlohmann::ordered_json data, std::string const& kind, std::string const& file,
                         std::string const& python);

}  // namespace vibrotrough::app
