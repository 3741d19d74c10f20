#pragma once

#include "scenario/reader/design.hpp"
#include "scenario/reader/file_reader.hpp"
#include "scenario/reader/run_section.hpp"

#include <string>
#include <string_view>

#include <toml++/toml.h>

namespace vibrotrough::scenario {

/// Whether a section of the campaign file belongs to the design: zip, points, points_from, sample, exclude.
bool is_design_section(std::string_view name);

/// Reads one of these sections into `campaign`: its lists, exclusions and files.
/// @param file  stands for the campaign file in errors; a CSV file of points lies beside it
/// @throws InputError, one line: file:line:column, key, what is wrong, what to write instead
/// @throws MissingError when the CSV file is there but cannot be read
void read_design_section(std::string_view name, toml::node const& node, std::string const& file,
                         ContentReader const& read, CampaignText& campaign);

/// Checks that no key, and no two keys that exclude each other, stand in two lists or in a list and the
/// sweep.
/// @throws InputError
void check_design(CampaignText const& campaign, std::string const& file);

}  // namespace vibrotrough::scenario
