#include "campaign/overview.hpp"

#include "campaign/case_state.hpp"
#include "campaign/folder_lock.hpp"
#include "store/result_file.hpp"

namespace vibrotrough::campaign {

namespace {

/// Whether a packing of the case is being simulated: a living driver, and a folder without its marker.
bool is_running(PlannedCase const& planned, bool driven) {
    if (!driven) return false;
    for (int packing = 1; packing <= planned.scenario.measure.packings; ++packing) {
        if (std::filesystem::is_directory(planned.packing_folder(packing)) &&
            !read_finished_packing(planned, packing)) {
            return true;
        }
    }
    return false;
}

CaseOverview look_at(PlannedCase const& planned, bool driven) {
    CaseOverview overview{&planned, "open", {}, 0, read_whole_result(planned)};
    if (overview.record) {
        overview.outcome = overview.record->outcome;
        overview.packings_done = planned.scenario.measure.packings;
        return overview;
    }
    overview.packings_done = count_finished_packings(planned);
    switch (case_state(planned)) {
        case CaseState::failed: {
            auto const failure = read_failure(planned);
            overview.outcome = failure ? failure->outcome : "failed";
            overview.message = failure ? failure->message : "failure.json is damaged";
            break;
        }
        case CaseState::started:
            overview.outcome = is_running(planned, driven) ? "running" : driven ? "open" : "interrupted";
            if (std::filesystem::exists(planned.result_file()))
                overview.message = "result.h5 is damaged; run again";
            break;
        case CaseState::open:
        case CaseState::finished:
            break;
    }
    return overview;
}

}  // namespace

std::vector<CaseOverview> look_at(Plan const& plan) {
    bool const driven = FolderLock::is_held(plan.folder);
    std::vector<CaseOverview> cases;
    for (PlannedCase const& planned : plan.cases) cases.push_back(look_at(planned, driven));
    return cases;
}

void write_campaign_file(Plan const& plan) {
    std::vector<store::CaseRecord> records;
    for (PlannedCase const& planned : plan.cases) {
        if (auto record = read_whole_result(planned)) records.push_back(std::move(*record));
    }
    store::write_campaign(plan.folder / "campaign.h5", plan.name, records);
}

}  // namespace vibrotrough::campaign
