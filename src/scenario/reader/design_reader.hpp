#pragma once

#include "scenario/reader/file_reader.hpp"

#include <string>
#include <string_view>

#include <toml++/toml.h>

namespace vibrotrough::scenario {

/// Whether a section of the campaign file belongs to the design: zip, points, points_from, sample,
/// exclude, domain.
bool is_design_section(std::string_view name);

/// Reads one of these sections into the lists, exclusions and files of `campaign`.
/// @param file  names the campaign file in errors; a CSV file of points is read from its folder
/// @throws core::InputError of one line: file:line:column, key, what is wrong, what to write instead
/// @throws core::MissingError when the CSV file exists but cannot be read
void read_design_section(std::string_view name, toml::node const& node, std::string const& file,
                         CampaignText& campaign);

/// Checks that no key is varied twice, in two lists or in a list and the sweep. Two keys that exclude each
/// other count as the same.
/// @param file  names the campaign file in errors
/// @throws core::InputError when a key is varied twice
void check_design(CampaignText const& campaign, std::string const& file);

}  // namespace vibrotrough::scenario
