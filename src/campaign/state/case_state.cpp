#include "campaign/state/case_state.hpp"

#include "campaign/outcome_names.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/time.hpp"
#include "store/result_file.hpp"

#include <nlohmann/json.hpp>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The file's content as JSON; nothing when it is missing or damaged.
std::optional<Json> read_json(fs::path const& path) {
    if (!fs::is_regular_file(path)) return {};
    Json json = Json::parse(core::read_file(path), nullptr, false);
    if (json.is_discarded() || !json.is_object()) return {};
    return json;
}

fs::path marker(PlannedCase const& planned, int packing) {
    return planned.packing_folder(packing) / "packing.json";
}

}  // namespace

std::string to_string(CaseState state) {
    switch (state) {
        case CaseState::finished:
            return "finished";
        case CaseState::failed:
            return "failed";
        case CaseState::started:
            return "started";
        case CaseState::open:
            return "open";
    }
    return "unknown";
}

std::optional<Failure> read_failure(PlannedCase const& planned) {
    auto const json = read_json(planned.failure_file());
    if (!json) return {};
    try {
        return Failure{json->at("outcome"), json->at("message"), json->at("packing"), json->at("attempts")};
    } catch (Json::exception const&) {
        return {};
    }
}

void write_failure(PlannedCase const& planned, Failure const& failure) {
    Json const json{{"case", planned.id},           {"outcome", failure.outcome},
                    {"message", failure.message},   {"packing", failure.packing},
                    {"attempts", failure.attempts}, {"try_again", retry_advice(failure.outcome)},
                    {"host", core::host_name()},    {"time", core::utc_now()}};
    core::make_folder(planned.folder);
    core::write_file_atomically(planned.failure_file(), json.dump(2) + "\n");
}

std::optional<store::CaseRecord> read_whole_result(PlannedCase const& planned) {
    if (!fs::is_regular_file(planned.result_file())) return {};
    try {
        store::CaseRecord record = store::read_result(planned.result_file());
        if (record.id == planned.id) return record;
    } catch (core::Error const&) {
        // Damaged: the case is as good as not run, and will be.
    }
    return {};
}

CaseState case_state(PlannedCase const& planned) {
    if (read_whole_result(planned)) return CaseState::finished;
    if (fs::is_regular_file(planned.failure_file())) return CaseState::failed;
    return fs::is_directory(planned.folder) ? CaseState::started : CaseState::open;
}

std::optional<FinishedPacking> read_finished_packing(PlannedCase const& planned, int packing) {
    if (!fs::is_regular_file(marker(planned, packing))) return {};
    return read_finished_packing(planned, packing, read_outputs(planned.packing_folder(packing)));
}

std::optional<FinishedPacking> read_finished_packing(PlannedCase const& planned, int packing,
                                                     PackingOutputs const& outputs) {
    auto const json = read_json(marker(planned, packing));
    if (!json || outputs.cycles.content.empty()) return {};
    try {
        if (json->at("cycles_sha256") != outputs.digest_of_cycles()) return {};
        if (json->at("layer_sha256") != outputs.digest_of_layer()) return {};
        return FinishedPacking{json->at("wall_time"),
                               json->at("started"),
                               json->at("finished"),
                               json->at("program_version"),
                               json->at("git_commit"),
                               json->at("host"),
                               json->value("engine_certificate", std::string())};
    } catch (Json::exception const&) {
        return {};
    }
}

void write_finished_packing(PlannedCase const& planned, int packing, FinishedPacking const& finished,
                            PackingOutputs const& outputs) {
    Json const json{{"wall_time", finished.wall_time},
                    {"started", finished.started},
                    {"finished", finished.finished},
                    {"program_version", finished.program_version},
                    {"git_commit", finished.git_commit},
                    {"host", finished.host},
                    {"engine_certificate", finished.engine_certificate},
                    {"cycles_sha256", outputs.digest_of_cycles()},
                    {"layer_sha256", outputs.digest_of_layer()}};
    core::write_file_atomically(marker(planned, packing), json.dump(2) + "\n");
}

int count_finished_packings(PlannedCase const& planned) {
    int count = 0;
    for (int packing = 1; packing <= planned.scenario.measure.packings; ++packing) {
        if (read_finished_packing(planned, packing)) ++count;
    }
    return count;
}

}  // namespace vibrotrough::campaign
