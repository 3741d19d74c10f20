#pragma once

#include "scenario/model/run_settings.hpp"
#include "scenario/reader/case_values.hpp"
#include "scenario/reader/design.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::scenario {

/// One key of the sweep and its values.
struct Axis {
    std::string key;              ///< path of the key
    std::vector<Content> values;  ///< each once, in the order of the file
    Position where;               ///< of the key
};

/// The campaign file as checked values, before the cases are made.
struct CampaignText {
    std::string name;                   ///< of the campaign
    CaseValues base;                    ///< the keys outside sweep and lists
    std::vector<Axis> sweep;            ///< in the order of the file
    std::vector<PointList> lists;       ///< zipped lists, points, samples
    std::vector<DomainAxis> domain;     ///< of the surface to learn; its first points are among `lists`
    std::vector<Exclusion> exclusions;  ///< cases to leave out
    std::vector<std::filesystem::path> files;  ///< CSV files of points that the campaign file names
    RunSettings run;                           ///< the section [run]
};

/// Parses the text, checks every key and value on its own, and checks that exactly one key of each group is
/// given.
/// @param file  names the campaign file in errors; CSV files of points are read from its folder
/// @throws core::InputError of one line: file:line:column, key, what is wrong, what to write instead
/// @throws core::MissingError when a CSV file of points cannot be read
CampaignText read_campaign_text(std::string_view text, std::string const& file);

}  // namespace vibrotrough::scenario
