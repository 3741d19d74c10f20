#pragma once

#include "scenario/model/scenario.hpp"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::scenario {

/// The keys of a campaign of one case, "section.key", with their values as TOML.
using WrittenKeys = std::map<std::string, std::string>;

/// All keys that to_toml() writes for a scenario, and its shape, which to_toml() leaves out for spheres.
WrittenKeys keys_of(Scenario const& scenario);

/// The number that a case has for a key, in SI units: written, or derived as value_of() does. Nothing when
/// the case has no such number.
/// @param key  path of a key that can be varied
std::optional<double> number_of(Scenario const& scenario, std::string_view key);

/// The word that a case has for a key, such as "rolling" for grains.rotation; nothing when it has none.
std::optional<std::string> word_of(Scenario const& scenario, std::string_view key);

/// The keys whose values differ between cases.
/// @throws core::InputError when one case gives a key that another does not
std::set<std::string> differing_keys(std::vector<WrittenKeys> const& cases);

/// The text of a campaign file with these cases in this order: the first as it is, and all as a list of
/// points of the keys in which they differ.
/// @param cases    at least one
/// @param comment  one line, which becomes the first line of the text
/// @throws core::InputError as differing_keys
std::string campaign_toml(std::vector<Scenario> const& cases, std::string const& comment);

}  // namespace vibrotrough::scenario
