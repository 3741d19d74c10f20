#pragma once

#include "campaign/state/notes.hpp"
#include "campaign/state/plan.hpp"
#include "evaluate/packing.hpp"
#include "store/case_record.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::campaign {

// What the files say of one case. Nothing here runs or removes anything; whatever writes says so.

/// The failure that failure.json names; none when there is no such file or it is damaged.
std::optional<Failure> read_failure(PlannedCase const& planned);

/// Writes failure.json. @throws core::MissingError when the disk refuses
void write_failure(PlannedCase const& planned, Failure const& failure);

/// Says anew whether a steady case is finished or not precise: another half-width may be wanted than when it
/// was evaluated.
void judge_again(PlannedCase const& planned, store::CaseRecord& record);

/// The case's result if result.h5 is there and whole; a damaged file counts as none.
std::optional<store::CaseRecord> read_whole_result(PlannedCase const& planned);

/// Numbers of the packings that have a folder, in order.
std::vector<int> started_packings(PlannedCase const& planned);

/// Numbers of the packings that are finished (marker and files belong together), in order.
std::vector<int> finished_packings(PlannedCase const& planned);

/// Cycles so far of the packings that were started and have not ended, by number.
std::map<int, int> cycles_under_way(PlannedCase const& planned);

/// The cycles of a packing that later runs do not change any more.
struct KnownPacking {
    std::vector<double> efficiency;  ///< velocity efficiency of each cycle
    double core_time = 0;            ///< s, processor time of the engine so far, all ranks
    bool is_finished = false;  ///< its run has ended and was found usable; else it was cut while it was being
                               ///< continued, and these are the cycles up to its checkpoint
};

/// Packings by number, from 1.
using KnownPackings = std::map<int, KnownPacking>;

/// The finished packings, and those that were interrupted and have a checkpoint.
KnownPackings read_known_packings(PlannedCase const& planned);

}  // namespace vibrotrough::campaign
