#pragma once

#include "scenario/case_values.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough {

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
};

/// Parses the text and checks every key and value for itself, and that each group of exclusive keys has one.
/// @throws InputError
CampaignText read_campaign_text(std::string_view text, std::string const& file);

}  // namespace vibrotrough
