#pragma once

#include "campaign/state/plan.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace vibrotrough::campaign {

/// Scenarios that a policy has added to the campaign in this folder beside those of the campaign file, in the
/// order in which they were added. Damaged entries are left out.
std::vector<scenario::Scenario> read_added_cases(std::filesystem::path const& folder);

/// Adds a case to a plan and remembers it in the campaign's folder (added/0001/scenario.toml ...), so that
/// every later look at the campaign includes it. A case that the plan has already is not added again.
/// @return the case of the plan if it is new, else nullptr
/// @throws core::InputError as make_plan, core::MissingError when the disk refuses
PlannedCase const* add_case(Plan& plan, scenario::Scenario const& scenario);

}  // namespace vibrotrough::campaign
