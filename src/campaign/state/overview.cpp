#include "campaign/state/overview.hpp"

#include "campaign/state/case_state.hpp"
#include "campaign/state/notes.hpp"
#include "campaign/state/numerics_results.hpp"
#include "campaign/state/observables.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/limits.hpp"
#include "core/parallel.hpp"
#include "core/version.hpp"
#include "evaluate/case.hpp"
#include "store/result_file.hpp"
#include "store/summary.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;

using Activities = std::vector<PackingActivity const*>;

/// Whether a packing of the case has a folder without a valid marker.
bool has_unfinished_packing(PlannedCase const& planned, std::size_t finished) {
    return started_packings(planned).size() > finished;
}

/// What the executors add to a case without a result: it runs or waits, or its packing ended without a word.
/// A failure.json that the packing's own process wrote says more than the executor does.
void add_activity(CaseOverview& overview, Activities const& activities) {
    auto const find = [&](PackingActivity::State state) {
        return std::ranges::find_if(activities, [&](PackingActivity const* one) {
            // A task that runs although its packing is finished is about to write the case's result.
            return one->state == state &&
                   (state == PackingActivity::running ||
                    !evaluate::read_marker(overview.planned->packing_folder(one->id.packing)));
        });
    };
    constexpr std::array<std::pair<PackingActivity::State, CaseStatus>, 3> alive{
        {{PackingActivity::running, CaseStatus::running},
         {PackingActivity::waiting, CaseStatus::queued},
         {PackingActivity::unknown, CaseStatus::unknown}}};
    for (auto const& [state, status] : alive) {
        auto const found = find(state);
        if (found == activities.end()) continue;
        overview.status = status;
        overview.outcome.reset();
        overview.message = state == PackingActivity::running ? "" : (*found)->message;
        return;
    }
    auto const ended = find(PackingActivity::ended);
    if (ended == activities.end() || overview.status == CaseStatus::failed) return;
    overview.outcome = (*ended)->outcome.value_or(core::Outcome::interrupted);
    overview.status =
        overview.outcome == core::Outcome::interrupted ? CaseStatus::interrupted : CaseStatus::failed;
    overview.message = fmt::format("packing {}: {}", (*ended)->id.packing, (*ended)->message);
}

ResultFacts facts_of(store::CaseRecord const& record) {
    ResultFacts facts{static_cast<int>(record.packings.size()), 0, 0, record.estimate.deviation};
    for (store::PackingRecord const& packing : record.packings) {
        facts.cycles += packing.estimate.discarded + packing.estimate.measured;
        facts.core_time += packing.core_time;
    }
    return facts;
}

CaseOverview survey_ended(PlannedCase const& planned, store::CaseRecord const& record) {
    CaseOverview overview{&planned, CaseStatus::ended, record.outcome, evaluate::remark_on(record),
                          0,        facts_of(record)};
    overview.packings_done = overview.result->packings;
    return overview;
}

/// Why nothing of a case can be read although something is there; empty when it can be, or nothing is.
std::string fault_of_folder(PlannedCase const& planned) {
    std::error_code missing;
    bool const is_readable = ::access(planned.folder.c_str(), R_OK | X_OK) == 0;
    if (is_readable || !fs::exists(planned.folder, missing)) return {};
    return fmt::format("its folder cannot be read ({})", core::reason_of(EACCES));
}

/// Why a result that is there was not used; empty when there is none.
std::string fault_of_result(PlannedCase const& planned) {
    std::error_code missing;
    return fs::exists(planned.result_file(), missing)
               ? "result.h5 is damaged or of an older version; run again"
               : "";
}

CaseOverview survey_without_result(PlannedCase const& planned, bool has_driver) {
    CaseOverview overview{&planned, CaseStatus::open, {}, {}, 0, {}};
    overview.fault = fault_of_folder(planned);
    if (!overview.fault.empty()) {
        overview.status = CaseStatus::interrupted;
        overview.message = overview.fault;
        return overview;
    }
    std::error_code missing;
    if (!fs::is_directory(planned.folder, missing)) return overview;
    auto const finished = finished_packings(planned).size();
    overview.packings_done = static_cast<int>(finished);
    std::string const fault = fault_of_result(planned);
    if (auto const failure = read_failure(planned)) {
        overview.status = CaseStatus::failed;
        overview.outcome = failure->outcome;
        overview.message = failure->message;
    } else if (fs::exists(planned.failure_file(), missing)) {
        overview.status = CaseStatus::failed;
        overview.message = overview.fault = "failure.json is damaged; remove it and run again";
    } else if (has_driver) {
        if (has_unfinished_packing(planned, finished)) overview.status = CaseStatus::running;
    } else if (!fault.empty() || has_unfinished_packing(planned, finished) ||
               overview.packings_done >= planned.scenario().measure.packings) {
        overview.status = CaseStatus::interrupted;
    }  // else its folder was only prepared, or the packings that were begun have ended and others are to come
    if (!fault.empty()) {
        overview.fault = fault;
        if (overview.status != CaseStatus::failed) overview.message = fault;
    }
    return overview;
}

/// The same for a case with files that cannot be read: the others are looked at all the same.
CaseOverview survey_readable(PlannedCase const& planned, bool has_driver) {
    try {
        return survey_without_result(planned, has_driver);
    } catch (core::MissingError const& error) {
        return {&planned, CaseStatus::interrupted, {}, error.what(), 0, {}, error.what()};
    }
}

/// The summaries of all results that are there, in the order of the plan.
/// @param complete  whether they get what the theory says of them, and those that had to be read from the
///                  results are written beside them
std::vector<store::CaseRecord> result_summaries(Plan const& plan, bool complete = false) {
    auto const studied = read_case_numerics(plan.folder);
    std::vector<store::CaseRecord> records;
    constexpr std::size_t part = 1024;  // all at once would fill the memory twice
    for (std::size_t begin = 0; begin < plan.cases.size(); begin += part) {
        std::vector<std::optional<store::CaseRecord>> found(std::min(part, plan.cases.size() - begin));
        core::for_each_index(found.size(), cases_per_thread, [&] {
            return [&](std::size_t i) {
                PlannedCase const& planned = plan.cases[begin + i];
                auto summary = find_summary(planned);
                if (!summary) return;
                if (complete && summary->is_from_result) write_summary(planned, summary->record);
                found[i] = std::move(summary->record);
                if (complete && planned.prepared->stages.empty())  // the theory is for one drive without end
                    found[i]->theory = prepare::point_mass_theory(planned.prepared->point_mass);
                if (auto const known = studied.find(planned.id); known != studied.end())
                    found[i]->studied_error = known->second;
            };
        });
        for (auto& record : found)
            if (record) records.push_back(std::move(*record));
    }
    return records;
}

/// The SHA-256 of all that campaign.h5 is made from. Times say nothing: a result that was copied keeps its
/// old one.
std::string digest_of(Plan const& plan, std::vector<store::CaseRecord> const& records,
                      std::vector<store::Observable> const& observables) {
    std::string facts = fmt::format("{}\n{}\n{}\n", core::program_commit(), plan.name, to_json(observables));
    for (scenario::Key const* const key : plan.swept) facts += fmt::format("{} ", key->path);
    for (store::CaseRecord const& record : records) {
        facts += store::digest_of_summary(record);
        if (record.studied_error) facts += fmt::format("{} ", *record.studied_error);
    }
    return core::sha256_hex(facts);
}

}  // namespace

std::string_view CaseOverview::label() const {
    if (outcome) return name_of(*outcome);
    switch (status) {
        case CaseStatus::open:
            return "open";
        case CaseStatus::queued:
            return "queued";
        case CaseStatus::running:
            return "running";
        case CaseStatus::unknown:
            return "unknown";
        case CaseStatus::interrupted:
            return "interrupted";
        case CaseStatus::failed:
            return "failed";
        case CaseStatus::ended:
            break;
    }
    return "finished";
}

std::vector<CaseOverview> survey(Plan const& plan, Activity const& activity, OverviewSink const& sink,
                                 Trust trust) {
    std::map<std::string_view, Activities> by_case;
    for (PackingActivity const& one : activity.packings) by_case[one.id.case_id].push_back(&one);
    std::vector<CaseOverview> cases(plan.cases.size());
    core::for_each_index(cases.size(), cases_per_thread, [&] {
        return [&](std::size_t i) {
            PlannedCase const& planned = plan.cases[i];
            auto const found = find_summary(planned, trust);
            cases[i] =
                found ? survey_ended(planned, found->record) : survey_readable(planned, activity.has_driver);
            auto const active = by_case.find(planned.id);
            if (active != by_case.end() && !found) add_activity(cases[i], active->second);
            if (sink) sink(i, cases[i], found ? &found->record : nullptr);
        };
    });
    return cases;
}

CampaignFileState campaign_file_state(Plan const& plan) {
    std::error_code none;
    fs::path const file = plan.folder / "campaign.h5";
    if (!fs::exists(file, none)) return CampaignFileState::missing;
    auto const records = result_summaries(plan);
    bool const fits =
        records.empty() || store::made_of(file) == digest_of(plan, records, read_observables(plan.folder));
    return fits ? CampaignFileState::up_to_date : CampaignFileState::outdated;
}

bool is_campaign_file_outdated(Plan const& plan) {
    CampaignFileState const state = campaign_file_state(plan);
    if (state != CampaignFileState::missing) return state != CampaignFileState::up_to_date;
    return std::ranges::any_of(plan.cases, [](PlannedCase const& planned) {
        std::error_code none;
        return fs::exists(planned.result_file(), none);
    });
}

void write_campaign_file(Plan const& plan) {
    auto const records = result_summaries(plan, true);
    auto const observables = read_observables(plan.folder);
    store::write_campaign(plan.folder / "campaign.h5", {.campaign = plan.name,
                                                        .cases = records,
                                                        .swept = plan.swept,
                                                        .observables = observables,
                                                        .made_of = digest_of(plan, records, observables)});
}

}  // namespace vibrotrough::campaign
