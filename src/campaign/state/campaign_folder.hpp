#pragma once

#include "campaign/state/plan.hpp"
#include "engine/engine.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace vibrotrough::campaign {

/// Copies the files that the scenario names into the folder. @throws core::MissingError when the disk refuses
void write_named_files(scenario::Scenario const& scenario, std::filesystem::path const& folder);

/// Writes a frozen scenario and the files that it names into a folder, which is made.
/// @throws core::MissingError when the disk refuses
void write_scenario(scenario::Scenario const& scenario, std::filesystem::path const& folder);

/// Makes the campaign's folder and freezes the campaign in it: campaign.toml, the engine's version
/// (engine.json) and its certificate (certificate.json).
/// @param campaign_file  that the plan was made from
/// @throws core::InputError when the folder holds another campaign
/// @throws core::MissingError when the disk refuses
void freeze(Plan const& plan, std::filesystem::path const& campaign_file, engine::Engine const& engine);

/// The plan of a folder that `freeze` made.
/// @throws core::InputError when it is not a campaign folder or is damaged
Plan open_plan(std::filesystem::path const& folder);

/// Writes what the folders of cases hold before their first packing is run, the frozen scenario: several at
/// the same time, because the file system may be slow. @throws core::MissingError when the disk refuses
void write_case_files(std::vector<PlannedCase const*> cases);

/// The campaign file that is frozen in a folder. @throws core::InputError as open_plan
scenario::Campaign read_frozen_campaign(std::filesystem::path const& folder);

/// The engine that the campaign in `folder` was planned with (engine.json).
/// @throws core::InputError when the file is damaged
engine::Engine read_engine(std::filesystem::path const& folder);

/// One case of a campaign folder from its own frozen scenario.toml: a task on a cluster reads this instead of
/// planning the whole campaign.
/// @throws core::InputError when the case is not there, or is not what its id says
PlannedCase open_case(std::filesystem::path const& folder, std::string const& id,
                      std::string const& engine_version);

/// Whether a text has the form of a case's id: 12 hexadecimal digits.
bool is_case_id(std::string_view text);

}  // namespace vibrotrough::campaign
