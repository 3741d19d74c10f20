#include "campaign/execute/case_end.hpp"

#include "campaign/assemble.hpp"
#include "campaign/state/case_state.hpp"
#include "campaign/state/file_lock.hpp"
#include "core/atomic_file.hpp"
#include "store/result_file.hpp"

namespace vibrotrough::campaign {
namespace {

FileLock lock_case(PlannedCase const& planned) {
    core::make_folder(planned.folder);
    return FileLock::wait_for(planned.folder / ".lock");
}

/// What a killed process left half-written; whoever writes here holds the case's lock.
void remove_halves(PlannedCase const& planned) {
    std::error_code ignored;
    for (auto const& entry : std::filesystem::directory_iterator(planned.folder, ignored)) {
        std::string const name = entry.path().filename().string();
        if (name.starts_with("result.h5.part-") || name.starts_with("failure.json.part-"))
            std::filesystem::remove(entry.path(), ignored);
    }
}

}  // namespace

std::optional<store::CaseRecord> finish_case(PlannedCase const& planned, std::string const& engine_version,
                                             MeasuredPackings known) {
    // A packing that ends now has its marker already: of two that end at once, at least one sees both.
    for (int packing = 1; packing <= planned.scenario.measure.packings; ++packing) {
        if (!known.contains(packing) && !read_finished_packing(planned, packing)) return {};
    }
    FileLock const lock = lock_case(planned);
    if (auto result = read_whole_result(planned)) return result;
    remove_halves(planned);
    store::CaseRecord record = assemble(planned, engine_version, std::move(known));
    store::write_result(planned.result_file(), record);
    std::filesystem::remove(planned.failure_file());
    return record;
}

void record_failure(PlannedCase const& planned, int packing, PackingOutcome const& outcome) {
    FileLock const lock = lock_case(planned);
    auto const before = read_failure(planned);
    write_failure(planned, {outcome.outcome, outcome.message, packing, before ? before->attempts + 1 : 1});
}

}  // namespace vibrotrough::campaign
