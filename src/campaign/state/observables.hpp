#pragma once

#include "store/observable.hpp"

#include <filesystem>
#include <vector>

namespace vibrotrough::campaign {

/// The file in a campaign's folder that keeps what 'vibrotrough observe' measured; campaign.h5 and the table
/// of `compare` are made from it.
constexpr char const* observables_file = "observables.json";

/// The observables of a campaign. Empty when there is no file.
/// @throws core::InputError when the file is damaged
std::vector<store::Observable> read_observables(std::filesystem::path const& campaign_folder);

/// Writes observables. Others that are in the file stay, also those of other results of a case's.
/// @throws core::MissingError when the disk refuses
/// @throws core::InputError when the file that is there is damaged
void write_observables(std::filesystem::path const& campaign_folder,
                       std::vector<store::Observable> const& observables);

}  // namespace vibrotrough::campaign
