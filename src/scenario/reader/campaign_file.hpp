#pragma once

#include "scenario/model/run_settings.hpp"
#include "scenario/model/scenario.hpp"
#include "scenario/reader/case_values.hpp"
#include "scenario/reader/swept_keys.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::scenario {

/// A campaign file, read and checked.
struct Campaign {
    std::string name;             ///< of the campaign
    std::vector<Scenario> cases;  ///< the product of sweep and lists without the excluded cases; at least one
    RunSettings run;              ///< how to run them
    std::vector<std::filesystem::path> files;  ///< CSV files of points that the campaign file names
    std::size_t excluded = 0;                  ///< number of cases that the exclusions left out
    SweptKeys swept = {};  ///< keys of the sweep and the lists that differ between the cases
};

/// Reads and checks a campaign file.
/// @throws core::InputError of one line: file:line:column, key, what is wrong, what to write instead
/// @throws core::MissingError when the file exists but cannot be read
Campaign read_campaign(std::filesystem::path const& path);

/// Reads and checks the text of a campaign file.
/// @param name    names the file in errors; CSV files of points are read from its folder
/// @param source  where to find shapes and waveforms
/// @throws core::InputError, core::MissingError as read_campaign
Campaign parse_campaign(std::string_view text, std::string const& name, FileSource const& source = {});

}  // namespace vibrotrough::scenario
