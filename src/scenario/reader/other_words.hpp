#pragma once

#include <string_view>

/// @file
/// What people write who know a quantity by another word than the campaign file's.

namespace vibrotrough::scenario {

/// The path of the key that is meant by a path whose last name is another word for it
/// ("grains.polydispersity", "trough.rpm", "mu"), or that belongs to another section ("grains.inclination");
/// empty when none is.
std::string_view key_in_other_words(std::string_view path);

/// The section that is meant by another word ("drive", "particles"); empty when none is.
std::string_view section_in_other_words(std::string_view name);

}  // namespace vibrotrough::scenario
