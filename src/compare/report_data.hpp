#pragma once

#include "campaign/state/overview.hpp"

#include <filesystem>
#include <vector>

namespace vibrotrough::compare {

/// Writes the files from which the figures and the report are drawn, so that the scripts compute no physics.
///
/// In `folder`:
/// - `campaign.json`: the campaign, its versions and its input, the columns of `compare` with their meanings,
///   and every case's row of them with the reason when it failed; where exactly one key is swept, also the
///   differences of `compare --contrast`;
/// - `theory_curves.csv`: fine curves of velocity efficiency, the same as `compare --theory-curves`;
/// - `point_mass/<id>.csv`: one period of the theory's point mass on each case's trough in SI units, empty
///   when its motion has no period;
/// - `records/`: measured motions with what the decks run of them (record_files.hpp).
///
/// @param activity  what the executors know of the campaign, for cases without a result
/// @returns what is known of the cases
/// @throws core::MissingError when a file cannot be written
std::vector<campaign::CaseOverview> write_report_data(campaign::Plan const& plan,
                                                      campaign::Activity const& activity,
                                                      std::filesystem::path const& folder);

}  // namespace vibrotrough::compare
