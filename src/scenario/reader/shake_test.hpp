#pragma once

#include "scenario/reader/campaign_file.hpp"

#include <filesystem>
#include <string>

namespace vibrotrough::scenario {

/// The campaign's layers, whatever design they come from, on a level trough that shakes along itself: one
/// case for each layer, with alpha = beta = 0, the machine number K, a plain sinusoid, and the amplitude of
/// the first case with that layer; a point for each where there are several.
/// @param machine_number  K = omega^2 r / g
/// @throws as read_campaign
std::string shake_test_campaign(std::filesystem::path const& campaign_file, double machine_number);

/// The same text for all cases that have the same grains, layer and trough surface, whatever drives them: a
/// hash, 12 hexadecimal digits.
std::string layer_key(Scenario const& scenario);

}  // namespace vibrotrough::scenario
