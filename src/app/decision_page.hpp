#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace vibrotrough::app {

/// Writes the page of a decision, one HTML file that needs no network and no other file, with
/// postprocess/decision_page.py.
/// @param data    what learn::design_page_data() or learn::corner_plot_data() gave
/// @param kind    "design" or "calibration"
/// @param file    to write
/// @param python  path of the Python to use; empty for the usual one
/// @throws core::MissingError when Python or one of its modules is missing, or the file cannot be written
void write_decision_page(nlohmann::ordered_json data, std::string const& kind, std::string const& file,
                         std::string const& python);

}  // namespace vibrotrough::app
