#pragma once

#include "campaign/state/plan.hpp"
#include "store/case_record.hpp"

#include <optional>

namespace vibrotrough::campaign {

// The summary of a result (store::summary_of) in a small file summary beside result.h5, so that tables
// of thousands of cases need not take the results apart. It is written by whatever writes or repairs results,
// never by a query, and counts only while size, time and inode of result.h5 are what they were when it was
// written. It may be deleted at any time.

/// What makes a summary believed besides size, time and inode of its result.
enum class Trust {
    bytes,  ///< the bytes of result.h5 have the SHA-256 that they had when the summary was made
    stamp,  ///< nothing: for a quick look at how far a campaign is, of which no number is published
};

/// A result's summary, and where it came from.
struct FoundSummary {
    store::CaseRecord record;  ///< without cycles, curves and decks
    bool is_from_result;       ///< result.h5 itself had to be read, because there was no valid summary
};

/// The case's summary if its result is there and whole. Writes nothing.
std::optional<FoundSummary> find_summary(PlannedCase const& planned, Trust trust = Trust::bytes);

/// Whether the case's result.h5 can be read whole now, with all its checksums, and is the one that `summary`
/// summarises. For whoever publishes the result itself, later than it asked find_summary().
bool is_summary_of_result(PlannedCase const& planned, store::CaseRecord const& summary);

/// Writes the summary of the result that is in the case's folder. A disk that refuses is ignored: the next
/// reader takes the result itself.
void write_summary(PlannedCase const& planned, store::CaseRecord const& record);

}  // namespace vibrotrough::campaign
