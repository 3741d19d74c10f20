#pragma once

#include "store/case_record.hpp"

#include <filesystem>
#include <vector>

namespace vibrotrough::store {

/// Versions of the layouts described in README.md of this room; raised when a reader must know.
constexpr int result_schema_version = 2;
constexpr int campaign_schema_version = 1;

/// Writes result.h5 under a temporary name, syncs and renames it. @throws MissingError when the disk refuses
void write_result(std::filesystem::path const& path, CaseRecord const& record);

/// Reads result.h5 back. Reading `scenario` uses the stored TOML text.
/// @throws InputError naming the file when it is damaged, is not a result file, or has another schema
CaseRecord read_result(std::filesystem::path const& path);

/// Writes campaign.h5: one table of all cases, a column per dataset, in the order given; atomically.
void write_campaign(std::filesystem::path const& path, std::string const& campaign,
                    std::vector<CaseRecord> const& cases);

}  // namespace vibrotrough::store
