#pragma once

#include "campaign/state/plan.hpp"
#include "evaluate/friction_test.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace vibrotrough::campaign {

/// Measures the friction tests of a campaign that are finished, and says of the others why they have no
/// number.
/// @param plan  of a campaign made by scenario::shake_test_campaign and run
std::vector<evaluate::LayerFriction> measure_friction(Plan const& plan);

/// Where `compare` finds the results of friction tests: DIR/friction.json.
std::filesystem::path friction_file(std::filesystem::path const& campaign_folder);

/// @throws core::MissingError when the disk refuses
void write_friction(std::filesystem::path const& campaign_folder,
                    std::vector<evaluate::LayerFriction> const& tests);

/// The tests that gave a number, by layer_key(); empty when there is no file.
/// @throws core::InputError when the file is damaged
std::map<std::string, evaluate::LayerFriction> read_friction(std::filesystem::path const& campaign_folder);

}  // namespace vibrotrough::campaign
