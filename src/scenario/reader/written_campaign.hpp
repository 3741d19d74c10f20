#pragma once

#include "scenario/model/scenario.hpp"
#include "scenario/reader/keys.hpp"

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::scenario {

/// The case as a campaign file of its own, in SI units with as many digits as needed: the same scenario
/// always gives the same text, and reading the text gives the same scenario. The text only names the files of
/// shape, waveform and templates; named_files() returns them.
std::string to_toml(Scenario const& scenario);

/// What a case is, as text: to_toml() in canonical form, whatever numbers of the drive the user gave, with
/// the digests of the files that it names, and without the name of the campaign and the limits of its cost.
std::string identity_of(Scenario const& scenario);

/// Values of a case by the paths of their keys.
using WrittenKeys = std::map<std::string_view, Content>;

/// All keys that to_toml() writes for a scenario, and those that it leaves out because the case has their
/// default.
WrittenKeys keys_of(Scenario const& scenario);

/// The keys whose values differ between cases.
/// @throws core::InputError when one case gives a key that another does not
std::set<std::string_view> differing_keys(std::vector<WrittenKeys> const& cases);

/// The text of a campaign file with these cases in this order: the first as it is, and all as a list of
/// points of the keys in which they differ.
/// @param cases    at least one
/// @param comment  one line, which becomes the first line of the text
/// @throws core::InputError as differing_keys
std::string campaign_toml(std::vector<Scenario> const& cases, std::string const& comment);

}  // namespace vibrotrough::scenario
