#pragma once

#include "campaign/state/plan.hpp"

#include <filesystem>

namespace vibrotrough::campaign {

/// What a submission found and did.
struct Submission {
    int finished = 0;   ///< cases with a result and outcome "finished"
    int unsure = 0;     ///< cases with a result that is not steady or not precise
    int in_queue = 0;   ///< packings that wait or run in Slurm from before
    int submitted = 0;  ///< packings submitted now
    int again = 0;      ///< of these, the ones whose task had died or failed before
    std::vector<long> jobs;
};

/// Makes the folder, freezes the campaign in it and submits every packing that is neither finished nor in
/// Slurm's queue, as job arrays; returns when they are submitted. A task that died is seen and submitted
/// again.
/// @param campaign_file  the file that the plan was made from
/// @param program        vibrotrough itself, as the compute nodes see it
/// @throws MissingError when another driver works on the folder, Slurm refuses or does not answer, or the
/// disk refuses
Submission submit_to_slurm(Plan const& plan, std::filesystem::path const& campaign_file,
                           engine::Engine const& engine, scenario::RunSettings const& settings,
                           std::filesystem::path const& program);

}  // namespace vibrotrough::campaign
