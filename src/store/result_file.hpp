#pragma once

#include "scenario/reader/swept_keys.hpp"
#include "store/case_record.hpp"
#include "store/observable.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace vibrotrough::store {

/// Version of the layout of result.h5, see src/manual/files.md. It is raised when an older reader would
/// misunderstand the file.
constexpr int result_schema_version = 3;
/// Version of the layout of campaign.h5.
constexpr int campaign_schema_version = 3;

/// Writes result.h5 under a temporary name, syncs it and renames it.
/// @throws core::MissingError when it cannot be written
void write_result(std::filesystem::path const& path, CaseRecord const& record);

/// Reads result.h5. The scenario comes from the TOML text that is stored in it.
/// @throws core::InputError naming the file when it is damaged, is not a result file, or has another schema
CaseRecord read_result(std::filesystem::path const& path);

/// What campaign.h5 holds.
struct CampaignContent {
    std::string campaign;                          ///< its name
    std::span<CaseRecord const> cases;             ///< a row for each, in this order
    scenario::SweptKeys swept = {};                ///< keys that differ between the cases: datasets swept/KEY
    std::span<Observable const> observables = {};  ///< a person's own quantities: groups observables/NAME
    /// Tells this content from any other; the root attribute made_of.
    std::string made_of = {};
};

/// Writes campaign.h5 as write_result() does.
/// @throws core::MissingError when it cannot be written
void write_campaign(std::filesystem::path const& path, CampaignContent const& content);

/// CampaignContent::made_of of a campaign.h5. None when it is damaged or of another version.
std::optional<std::string> made_of(std::filesystem::path const& path);

}  // namespace vibrotrough::store
