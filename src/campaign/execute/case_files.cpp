#include "campaign/execute/case_files.hpp"

#include "campaign/state/case_state.hpp"
#include "campaign/state/checkpoint.hpp"
#include "campaign/state/result_summary.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "evaluate/case.hpp"
#include "store/result_file.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace vibrotrough::campaign {
namespace {

FileLock lock_case(PlannedCase const& planned) {
    core::make_folder(planned.folder);
    return FileLock::wait_for(planned.folder / ".lock");
}

bool is_made_of(store::CaseRecord const& record, ResultParts const& parts) {
    return record.packings.size() == parts.packings.size() &&
           std::ranges::all_of(record.packings, [&](store::PackingRecord const& packing) {
               return packing.series.cycles() == parts.cycles;
           });
}

/// A packing from its folder. @throws DamagedPacking
evaluate::EvaluatedPacking read_whole_packing(PlannedCase const& planned, int packing, int cycles) {
    try {
        if (auto one =
                evaluate::read_packing(*planned.prepared, packing, planned.packing_folder(packing), cycles))
            return std::move(*one);
    } catch (core::InputError const& error) {
        throw DamagedPacking(packing, error.what());
    }
    throw DamagedPacking(
        packing, fmt::format("packing {} of case {} is not finished or is damaged", packing, planned.id));
}

}  // namespace

store::CaseRecord finish_case(PlannedCase const& planned, std::string const& engine_version,
                              ResultParts const& parts, evaluate::EvaluatedPackings evaluated) {
    FileLock const lock = lock_case(planned);
    if (auto result = read_whole_result(planned); result && is_made_of(*result, parts))
        return std::move(*result);
    evaluate::EvaluatedPackings used;
    for (int const packing : parts.packings) {
        auto known = evaluated.extract(packing);
        bool const is_known = !known.empty() && known.mapped().record.series.cycles() == parts.cycles;
        used.emplace(packing, is_known ? std::move(known.mapped())
                                       : read_whole_packing(planned, packing, parts.cycles));
    }
    store::CaseRecord record =
        evaluate::evaluate_case(*planned.prepared, planned.id, engine_version, std::move(used));
    store::write_result(planned.result_file(), record);
    write_summary(planned, record);
    std::filesystem::remove(planned.failure_file());
    if (record.outcome == core::Outcome::finished) {  // the packings of other cases may be continued
        for (int const packing : parts.packings) remove_checkpoints(planned.packing_folder(packing));
    }
    return record;
}

void record_failure(PlannedCase const& planned, int packing, core::Outcome outcome,
                    std::string const& message, int attempts_before) {
    try {
        FileLock const lock = lock_case(planned);
        auto const before = read_failure(planned);
        int const attempts = std::max(attempts_before, before ? before->attempts : 0);
        write_failure(planned, {outcome, message, packing, attempts + 1});
    } catch (core::DiskFullError const&) {
        // Whoever reports the failure says so. Without the file the case is one that was interrupted.
        if (outcome != core::Outcome::disk_full) throw;
    }
}

std::optional<FileLock> lock_packing(PlannedCase const& planned, int packing) {
    return FileLock::take(planned.folder / fmt::format(".packing-{}.lock", packing));
}

FileLock require_packing(PlannedCase const& planned, int packing) {
    if (auto lock = lock_packing(planned, packing)) return std::move(*lock);
    throw core::MissingError(fmt::format(
        "another process runs packing {} of case {} (a task of a cluster, or 'vibrotrough work'); "
        "wait for it, or end it",
        packing, planned.id));
}

}  // namespace vibrotrough::campaign
