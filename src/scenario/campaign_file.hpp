#pragma once

#include "scenario/case_values.hpp"
#include "scenario/scenario.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough {

/// A campaign file, read and checked.
struct Campaign {
    std::string name;
    std::vector<Scenario> cases;  ///< the Cartesian product of the sweep; at least one
};

/// Reads and checks a campaign file.
/// @throws InputError, one line: file:line:column, key, what is wrong, what to write instead
/// @throws MissingError when the file is there but cannot be read
Campaign read_campaign(std::filesystem::path const& path);

/// The same for a text; `name` stands for the file in errors.
Campaign parse_campaign(std::string_view text, std::string const& name, FileSource const& source = {});

}  // namespace vibrotrough
