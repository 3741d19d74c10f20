#pragma once

#include "campaign/state/plan.hpp"
#include "campaign/state/result_summary.hpp"
#include "core/outcome.hpp"
#include "store/case_record.hpp"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::campaign {

/// Where a case stands.
enum class CaseStatus {
    open,         ///< nothing was done yet
    queued,       ///< waits with the executor
    running,      ///< a packing is being simulated
    unknown,      ///< the executor does not answer
    interrupted,  ///< begun, and nobody works on it now
    failed,       ///< failure.json or the executor says why
    ended,        ///< it has a result
};

/// What an executor knows of a packing that it was given and that has no marker yet.
struct PackingActivity {
    /// Where a packing stands with the executor.
    enum State {
        waiting,  ///< in the executor's queue
        running,
        ended,    ///< the executor is done with it, well or not
        unknown,  ///< the executor does not answer: it may be anything
    };
    PackingId id;  ///< which packing
    State state;   ///< where it stands
    /// Of a packing that ended without a word of its own, e.g. core::Outcome::time_limit.
    std::optional<core::Outcome> outcome = {};
    std::string message = {};  ///< one line for people
};

/// What the executors know of a campaign.
struct Activity {
    bool has_driver = false;                ///< a program on this machine drives the campaign now
    std::vector<PackingActivity> packings;  ///< what the executors know of packings
};

/// What a result says of its cost.
struct ResultFacts {
    int packings;                     ///< that it is made of
    double cycles;                    ///< of all packings, with those that were cut as start-up
    double core_time;                 ///< s, processor time of the engine
    std::optional<double> deviation;  ///< standard deviation of the mean efficiency of one packing
};

/// What is known about one case of a plan.
struct CaseOverview {
    PlannedCase const* planned;            ///< the case
    CaseStatus status;                     ///< where it stands
    std::optional<core::Outcome> outcome;  ///< of the result or of the failure
    std::string message;                   ///< why it failed or waits
    int packings_done;                     ///< finished packings
    std::optional<ResultFacts> result;     ///< of a case that has one
    /// Why files of the case that are there cannot be used; empty when there is no such file.
    std::string fault = {};

    /// The outcome's name, else that of the status: open, queued, running, unknown, interrupted.
    std::string_view label() const;
};

/// Sees what is known of case i of a plan, and the summary of its result (store::summary_of), which is null
/// without one. Several threads call it at once, for different cases.
using OverviewSink =
    std::function<void(std::size_t i, CaseOverview const& overview, store::CaseRecord const* record)>;

/// What the files and the executors say of every case of a plan. Writes nothing. The summaries of all results
/// would fill the memory: whoever needs more than their facts looks at them one by one.
/// @param trust  what makes a result believed
std::vector<CaseOverview> survey(Plan const& plan, Activity const& activity, OverviewSink const& sink = {},
                                 Trust trust = Trust::bytes);

/// How campaign.h5 stands to the files from which it is made. Without a result, any one is up to date.
enum class CampaignFileState {
    up_to_date,  ///< it holds what there is
    missing,     ///< there is none
    outdated,    ///< it is damaged, or made from other results, keys or by another version of the program
};

/// Whether campaign.h5 is made from what there is now.
CampaignFileState campaign_file_state(Plan const& plan);

/// Whether campaign.h5 should be written: it is not up to date, and there is a result.
bool is_campaign_file_outdated(Plan const& plan);

/// Writes campaign.h5 from the results that are there. It can be made again at any time.
/// @throws core::MissingError when the disk refuses
void write_campaign_file(Plan const& plan);

}  // namespace vibrotrough::campaign
