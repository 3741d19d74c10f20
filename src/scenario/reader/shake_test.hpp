#pragma once

#include "scenario/reader/campaign_file.hpp"

#include <filesystem>
#include <string>

namespace vibrotrough::scenario {

/// The text of the campaign that measures the friction of layers: one case for each layer of the given
/// campaign, on a level trough that vibrates along its own surface. These cases have alpha = beta = 0, the
/// machine number K, a plain sinusoid, and the amplitude of the first case with that layer.
/// @param machine_number  K = omega^2 r / g
/// @throws core::InputError, core::MissingError as read_campaign
std::string shake_test_campaign(std::filesystem::path const& campaign_file, double machine_number);

/// A hash (12 hexadecimal digits) that is the same for all cases with the same grains, layer and trough
/// surface, whatever their drive.
std::string layer_key(Scenario const& scenario);

}  // namespace vibrotrough::scenario
