#pragma once

#include "campaign/execute/packing_run.hpp"
#include "campaign/state/file_lock.hpp"
#include "campaign/state/plan.hpp"
#include "core/error.hpp"
#include "evaluate/packing.hpp"

#include <optional>
#include <vector>

namespace vibrotrough::campaign {

// The end of a case, whichever process ran its packings. Several processes, also on several machines, may
// call these at once: a lock of the case lets one at a time through.

/// What a result is made of.
struct ResultParts {
    std::vector<int> packings;  ///< by number; all of them are finished
    int cycles;                 ///< of each of them, from the first
};

/// A packing of a result that is not finished, or whose files are damaged.
class DamagedPacking : public core::InputError {
  public:
    /// @param packing  its number
    /// @param message  one line without a line end
    DamagedPacking(int packing, std::string const& message) : InputError(message), packing_(packing) {}
    int packing() const { return packing_; }  ///< its number

  private:
    int packing_;
};

/// Writes the case's result, unless it has one from as many packings and cycles. The packings' checkpoints
/// are removed.
/// @param evaluated  those of them that this process measured itself; the others are read from their folders
/// @return the result, also when it was there before
/// @throws DamagedPacking for the first one that is not finished or has damaged files
/// @throws core::MissingError when the disk refuses
store::CaseRecord finish_case(PlannedCase const& planned, std::string const& engine_version,
                              ResultParts const& parts, evaluate::EvaluatedPackings evaluated = {});

/// Writes failure.json for a packing that failed, and counts the attempts. A disk that is full for the
/// packing may be so for this file; then there is none.
/// @param attempts_before  that are known to have failed, when failure.json may have been removed since
/// @throws core::MissingError when the disk refuses
void record_failure(PlannedCase const& planned, int packing, core::Outcome outcome,
                    std::string const& message, int attempts_before = 0);

/// The lock of whoever runs a packing, or removes files from its folder: a driver or a task of a cluster. It
/// holds wherever the engine works, and the engine does not inherit it. None when another
/// process has it.
/// @throws core::MissingError when the file cannot be made
std::optional<FileLock> lock_packing(PlannedCase const& planned, int packing);

/// The same lock for a process that cannot do without it.
/// @throws core::MissingError when another process has it, and as lock_packing()
FileLock require_packing(PlannedCase const& planned, int packing);

}  // namespace vibrotrough::campaign
