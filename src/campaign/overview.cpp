#include "campaign/overview.hpp"

#include "campaign/case_state.hpp"
#include "campaign/folder_lock.hpp"
#include "store/result_file.hpp"

namespace vibrotrough::campaign {

std::vector<CaseOverview> look_at(Plan const& plan) {
    bool const driven = FolderLock::is_held(plan.folder);
    std::vector<CaseOverview> cases;
    for (PlannedCase const& planned : plan.cases) {
        CaseOverview overview{&planned, "open", {}, 0, read_whole_result(planned)};
        if (overview.record) {
            overview.outcome = overview.record->outcome;
            overview.packings_done = planned.scenario.measure.packings;
        } else if (std::filesystem::is_directory(planned.folder)) {
            overview.packings_done = count_finished_packings(planned);
            overview.outcome = driven ? "running" : "interrupted";
            if (auto const failure = read_failure(planned); failure && !driven) {
                overview.outcome = failure->outcome;
                overview.message = failure->message;
            }
        }
        cases.push_back(std::move(overview));
    }
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
