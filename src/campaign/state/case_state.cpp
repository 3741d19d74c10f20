#include "campaign/state/case_state.hpp"

#include "campaign/state/checkpoint.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "core/time.hpp"
#include "evaluate/case.hpp"
#include "prepare/numerical_errors.hpp"
#include "store/result_file.hpp"

#include <algorithm>
#include <charconv>

#include <nlohmann/json.hpp>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;
using core::note::Json;

/// The number of a folder "packing-<number>".
std::optional<int> packing_number(std::string_view name) {
    constexpr std::string_view start = "packing-";
    if (!name.starts_with(start)) return {};
    name.remove_prefix(start.size());
    int number = 0;
    auto const [end, failure] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (failure != std::errc() || end != name.data() + name.size() || number < 1) return {};
    return number;
}

}  // namespace

std::optional<Failure> read_failure(PlannedCase const& planned) {
    std::error_code missing;
    if (!fs::is_regular_file(planned.failure_file(), missing)) return {};
    try {
        return parse_failure(core::read_file(planned.failure_file(), core::largest_note));
    } catch (core::note::Fault const&) {
        return {};
    }
}

void write_failure(PlannedCase const& planned, Failure const& failure) {
    Json const json{{"case", planned.id},           {"outcome", name_of(failure.outcome)},
                    {"message", failure.message},   {"packing", failure.packing},
                    {"attempts", failure.attempts}, {"try_again", retry_advice(failure.outcome)},
                    {"host", core::host_name()},    {"time", core::utc_now()}};
    core::make_folder(planned.folder);
    core::write_file_atomically(planned.failure_file(), json.dump(2) + "\n");
}

void judge_again(PlannedCase const& planned, store::CaseRecord& record) {
    using enum core::Outcome;
    bool const is_steady = record.outcome == finished || record.outcome == not_precise;
    if (!is_steady || !record.estimate.half_width) return;
    bool const is_enough = prepare::is_narrow_enough(*record.estimate.half_width, planned.scenario());
    record.outcome = is_enough ? finished : not_precise;
}

std::optional<store::CaseRecord> read_whole_result(PlannedCase const& planned) {
    std::error_code missing;
    if (!fs::is_regular_file(planned.result_file(), missing)) return {};
    try {
        store::CaseRecord record = store::read_result(planned.result_file());
        if (record.id != planned.id) return {};
        judge_again(planned, record);
        return record;
    } catch (core::Error const&) {
        // Damaged: the case is as good as not run, and will be run.
    }
    return {};
}

std::vector<int> started_packings(PlannedCase const& planned) {
    std::vector<int> numbers;
    std::error_code missing;
    for (auto const& entry : fs::directory_iterator(planned.folder, missing)) {
        if (auto const number = packing_number(entry.path().filename().string())) numbers.push_back(*number);
    }
    std::ranges::sort(numbers);
    return numbers;
}

std::vector<int> finished_packings(PlannedCase const& planned) {
    std::vector<int> finished;
    for (int const packing : started_packings(planned)) {
        if (evaluate::read_marker(planned.packing_folder(packing))) finished.push_back(packing);
    }
    return finished;
}

std::map<int, int> cycles_under_way(PlannedCase const& planned) {
    std::map<int, int> found;
    for (int const packing : started_packings(planned)) {
        fs::path const folder = planned.packing_folder(packing);
        if (!evaluate::has_marker(folder))
            found[packing] = evaluate::extent_of_run(*planned.prepared, folder).cycles;
    }
    return found;
}

KnownPackings read_known_packings(PlannedCase const& planned) {
    KnownPackings known;
    prepare::PreparedCase const& prepared = *planned.prepared;
    for (int const packing : started_packings(planned)) {
        fs::path const folder = planned.packing_folder(packing);
        if (auto finished = evaluate::read_finished_cycles(prepared, folder)) {
            known[packing] = {std::move(finished->efficiency), finished->core_time, true};
            continue;
        }
        auto const checkpoint = read_own_checkpoint(folder, prepared.time.steps_per_cycle);
        if (!checkpoint) continue;
        try {
            known[packing] = {evaluate::read_efficiency(prepared, folder, checkpoint->cycle),
                              checkpoint->core_time, false};
        } catch (core::Error const&) {
            // Damaged: the packing starts anew.
        }
    }
    return known;
}

}  // namespace vibrotrough::campaign
