#pragma once

#include "campaign/state/plan.hpp"

#include <filesystem>

namespace vibrotrough::app {

/// What the figures and the report show beside campaign.h5, so that they compute no physics: in `folder`
///   campaign.json        the campaign, its versions, its input, the columns of `compare` with their
///   meanings,
///                        every case's row of them, why it failed
///   theory_curves.csv    fine curves of velocity efficiency, as `compare --theory-curves`
///   point_mass/<id>.csv  the theory's point mass over one period on each case's trough, SI; empty without a
///   period
/// and campaign.h5 made anew when it lacks a finished case.
/// Returns the number of cases that have a result.
/// @throws MissingError when the disk refuses
int write_report_data(campaign::Plan const& plan, std::filesystem::path const& folder);

}  // namespace vibrotrough::app
