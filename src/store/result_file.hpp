#pragma once

#include "scenario/reader/swept_keys.hpp"
#include "store/case_record.hpp"
#include "store/observable.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace vibrotrough::store {

/// Version of the layout of result.h5, see the README of this room. It is raised when an older reader would
/// misunderstand the file.
constexpr int result_schema_version = 2;
/// Version of the layout of campaign.h5.
constexpr int campaign_schema_version = 1;

/// Writes result.h5 under a temporary name, syncs it and renames it.
/// @throws core::MissingError when it cannot be written
void write_result(std::filesystem::path const& path, CaseRecord const& record);

/// Reads result.h5. The scenario comes from the TOML text that is stored in it.
/// @throws core::InputError naming the file when it is damaged, is not a result file, or has another schema
CaseRecord read_result(std::filesystem::path const& path);

/// The bytes of campaign.h5: one dataset per column, with one value for each case in the order given. The
/// same cases make the same bytes, so that a file holds these cases exactly if its bytes are these.
/// @param swept        keys that differ between the cases, each of which becomes a dataset swept/KEY
/// @param observables  a person's own quantities, each of which becomes a group observables/NAME
std::string campaign_bytes(std::string const& campaign, std::span<CaseRecord const> cases,
                           scenario::SweptKeys const& swept = {},
                           std::span<Observable const> observables = {});

/// Writes campaign.h5 atomically, with campaign_bytes().
/// @throws core::MissingError when it cannot be written
void write_campaign(std::filesystem::path const& path, std::string const& campaign,
                    std::vector<CaseRecord> const& cases, scenario::SweptKeys const& swept = {},
                    std::span<Observable const> observables = {});

/// Whether a campaign.h5 is what this program would write, as far as the cases do not matter.
enum class CampaignFit {
    fits,           ///< written by this version of the program for the same swept keys
    damaged,        ///< it cannot be read
    other_keys,     ///< other keys are swept
    other_version,  ///< written by another version of the program
};

/// Compares a campaign.h5 with these swept keys and with this program.
CampaignFit fit_of_campaign(std::filesystem::path const& path, scenario::SweptKeys const& swept);

}  // namespace vibrotrough::store
