#pragma once

#include "campaign/state/plan.hpp"
#include "engine/engine.hpp"
#include "measure/estimate.hpp"

#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::campaign {

/// A packing that is being simulated now.
struct RunningPacking {
    PlannedCase const* planned;
    int packing;
    int cycles;
    std::optional<measure::PackingEstimate> estimate;  ///< of velocity efficiency, from the cycles so far
    double elapsed;                                    ///< s
    double time_to_go;                                 ///< s, negative while unknown
};

/// Where a campaign stands.
struct Progress {
    int finished = 0;             ///< cases with a result
    int failed = 0;               ///< cases that failed in this run
    int running = 0;              ///< packings being simulated
    int left = 0;                 ///< cases neither finished nor failed, running ones included
    int packings_done = 0;        ///< of all unfinished cases, in this run and before
    int packings = 0;             ///< of all cases that this run works on
    double elapsed = 0;           ///< s
    double time_to_go = -1;       ///< s, negative while unknown
    double core_time = 0;         ///< core seconds spent on results and on what runs now
    double core_time_to_go = -1;  ///< core seconds, negative while unknown
    std::vector<RunningPacking> engines;
};

/// Is told what happens. Called from the executor's thread.
class Observer {
  public:
    virtual ~Observer() = default;
    virtual void progressed(Progress const& progress) = 0;  ///< about four times a second
    virtual void case_ended(PlannedCase const& planned, std::string const& outcome,
                            std::string const& message) = 0;
};

struct Summary {
    int finished = 0;  ///< cases with a result and outcome "finished"
    int unsure = 0;    ///< cases with a result whose outcome is "not-steady" or "not-precise"
    int failed = 0;    ///< cases without a result
    bool interrupted = false;
};

/// Makes the folder, freezes the campaign in it and runs every packing of every case that is not finished,
/// on `jobs` cores of this machine, the longest expected first. SIGINT and SIGTERM end the engines and
/// return. A failed case does not stop the others.
/// @param campaign_file  the file that the plan was made from
/// @param settings       retries, ranks and time limit
/// @param jobs           cores to use, at least 1
/// @throws MissingError when another driver works on the folder or the disk refuses (the engines are ended
/// first)
Summary run_locally(Plan const& plan, std::filesystem::path const& campaign_file,
                    engine::Engine const& engine, scenario::RunSettings const& settings, int jobs,
                    Observer& observer);

}  // namespace vibrotrough::campaign
