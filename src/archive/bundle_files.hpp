#pragma once

#include "campaign/state/overview.hpp"

#include <string>
#include <vector>

namespace vibrotrough::archive {

// The files that go into a bundle, by their names below the campaign's folder, which are those in the bundle.

/// What is frozen of a campaign and what belongs to it as a whole: campaign file, engine, certificate, files
/// that the campaign names, added cases, friction and numerical error, campaign.h5 if it is up to date,
/// figures and report.
std::vector<std::string> files_of_campaign(campaign::Plan const& plan);

/// What belongs to a case: its scenario with the files that it names, its result or failure, and the decks of
/// its packings.
std::vector<std::string> files_of_case(campaign::Plan const& plan, campaign::PlannedCase const& planned);

}  // namespace vibrotrough::archive
