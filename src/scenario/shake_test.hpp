#pragma once

#include "scenario/campaign_file.hpp"

#include <filesystem>
#include <string>

namespace vibrotrough {

/// The campaign's layers on a level trough that shakes along itself: the campaign file with alpha = beta = 0,
/// the machine number K, plain sinusoidal drive, and no sweep over the drive (of a swept amplitude the first
/// value). Everything else stays, sweeps over grains, layer and friction too.
/// @param machine_number  K = omega^2 r / g
/// @throws as read_campaign
std::string shake_test_campaign(std::filesystem::path const& campaign_file, double machine_number);

/// The same text for all cases that have the same grains, layer and trough surface, whatever drives them: a
/// hash, 12 hexadecimal digits.
std::string layer_key(Scenario const& scenario);

}  // namespace vibrotrough
