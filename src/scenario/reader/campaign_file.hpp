#pragma once

#include "scenario/model/run_settings.hpp"
#include "scenario/model/scenario.hpp"
#include "scenario/reader/case_values.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::scenario {

/// A campaign file, read and checked.
struct Campaign {
    std::string name;
    std::vector<Scenario>
        cases;        ///< the Cartesian product of the sweep and the lists, less the exclusions; at least one
    RunSettings run;  ///< how to run them
    std::vector<std::filesystem::path> files;  ///< that the campaign file reads: CSV files of points
    std::size_t excluded = 0;                  ///< cases that the exclusions left out
};

/// Reads and checks a campaign file.
/// @throws InputError, one line: file:line:column, key, what is wrong, what to write instead
/// @throws MissingError when the file is there but cannot be read
Campaign read_campaign(std::filesystem::path const& path);

/// The same for a text; `name` stands for the file in errors.
Campaign parse_campaign(std::string_view text, std::string const& name, FileSource const& source = {});

}  // namespace vibrotrough::scenario
