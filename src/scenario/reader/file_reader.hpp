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
    std::string key;
    std::vector<Content> values;
    Position where;
};

/// The campaign file as checked values, before the sweep is multiplied out.
struct CampaignText {
    std::string name;
    CaseValues base;
    std::vector<Axis> sweep;
    std::vector<PointList> lists;
    std::vector<Exclusion> exclusions;
    std::vector<std::filesystem::path> files;  ///< that the campaign file names
    RunSettings run;
};

/// Parses the text and checks every key and value for itself, and that each group of exclusive keys has one.
/// @throws InputError
CampaignText read_campaign_text(std::string_view text, std::string const& file);

}  // namespace vibrotrough::scenario
