#pragma once

#include "engine/engine.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace vibrotrough::campaign {

/// One case of a campaign and the folder that holds all about it.
struct PlannedCase {
    std::string id;  ///< 12 hexadecimal digits of the hash of scenario, deck and engine version
    scenario::Scenario scenario;
    std::filesystem::path folder;

    std::filesystem::path result_file() const { return folder / "result.h5"; }
    std::filesystem::path failure_file() const { return folder / "failure.json"; }
    /// The certificate of the engine that the campaign was planned with.
    std::filesystem::path certificate_file() const {
        return folder.parent_path().parent_path() / "certificate.json";
    }
    std::filesystem::path packing_folder(int packing) const {
        return folder / ("packing-" + std::to_string(packing));
    }
};

/// A campaign on disk.
struct Plan {
    std::string name;
    std::filesystem::path folder;
    std::string engine_version;
    std::vector<PlannedCase> cases;
    std::vector<std::filesystem::path> files = {};  ///< that the campaign file reads
};

/// Works out the cases' ids and folders below `folder`. The same case always has the same id: it does not
/// depend on the campaign's name or on its other cases.
Plan make_plan(scenario::Campaign const& campaign, std::filesystem::path const& folder,
               std::string const& engine_version);

/// Puts the files that the scenario names into the folder.
/// @throws MissingError when the disk refuses
void write_named_files(scenario::Scenario const& scenario, std::filesystem::path const& folder);

/// Makes the case's folder with its frozen scenario.
/// @throws MissingError when the disk refuses
void write_case_files(PlannedCase const& planned);

/// Makes the folder and freezes the campaign there: campaign.toml, the engine's version (engine.json)
/// and its certificate (certificate.json).
/// @throws MissingError when the disk refuses
void freeze(Plan const& plan, std::filesystem::path const& campaign_file, engine::Engine const& engine);

/// The plan of a folder that `freeze` made.
/// @throws InputError when it is no campaign folder or is damaged
Plan open_plan(std::filesystem::path const& folder);

/// The engine that the campaign in `folder` was planned with (engine.json).
/// @throws InputError when the file is damaged
engine::Engine read_engine(std::filesystem::path const& folder);

/// One case of a campaign folder from its own frozen scenario.toml: what a task on a cluster reads instead of
/// planning the whole campaign.
/// @throws InputError when the case is not there, or is not what its id says
PlannedCase open_case(std::filesystem::path const& folder, std::string const& id,
                      std::string const& engine_version);

}  // namespace vibrotrough::campaign
