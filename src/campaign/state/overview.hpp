#pragma once

#include "campaign/state/plan.hpp"
#include "store/case_record.hpp"

#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::campaign {

/// What is known about one case of a plan.
struct CaseOverview {
    PlannedCase const* planned;
    std::string outcome;  ///< of the result or the failure; else "running", "queued" (in Slurm), "unknown"
                          ///< (Slurm does not answer), "interrupted" or "open"
    std::string message;  ///< why it failed
    int packings_done;
    std::optional<store::CaseRecord> record;  ///< its summary (store::summary_of)
};

/// Looks at every case's files.
std::vector<CaseOverview> look_at(Plan const& plan);

/// Number of case folders that are no part of the plan: of an earlier version of the campaign or of a program
/// whose decks were others.
std::size_t count_left_aside(Plan const& plan);

/// Writes campaign.h5 from the results that are there; it can be made anew at any time.
/// @throws MissingError when the disk refuses
void write_campaign_file(Plan const& plan);

}  // namespace vibrotrough::campaign
