#pragma once

#include "campaign/state/overview.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace vibrotrough::archive {

/// A file that goes into a bundle as it lies in the campaign's folder.
struct StoredFile {
    std::string name;              ///< in the bundle, and below the campaign's folder
    std::filesystem::path source;  ///< where it lies
};

/// What is frozen of a campaign and what belongs to it as a whole: campaign file, engine, certificate, files
/// that the campaign names, added cases, friction and numerical error, campaign.h5 if it is up to date,
/// figures and report.
std::vector<StoredFile> files_of_campaign(campaign::Plan const& plan);

/// What belongs to a case: its scenario with the files that it names, its result or failure, and the decks of
/// its packings.
std::vector<StoredFile> files_of_case(campaign::Plan const& plan, campaign::PlannedCase const& planned);

}  // namespace vibrotrough::archive
