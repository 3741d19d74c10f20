#pragma once

#include "campaign/state/overview.hpp"

#include <vector>

namespace vibrotrough::campaign {

/// What a campaign would still cost.
struct Forecast {
    double speed = 0;                  ///< grain-steps of a small layer per second and core
    int results = 0;                   ///< cases that the forecast rests on, with their speed
    bool is_of_last_campaign = false;  ///< the speed, because there are no results
    double core_time = 0;              ///< s, of all packings that are missing
    double uncertainty = 1;  ///< the true core time is probably within core_time / u and core_time * u
    std::vector<double>
        cases;  ///< s of a core per case, in the order of the plan; 0 where nothing is missing
    std::vector<int> packings;  ///< per case, that it has or will probably have in the end
};

/// Estimates the cost of what is missing.
///
/// A case needs so many packings that its interval becomes as narrow as measure.half_width asks
/// (deck::expected_packings, the same as in `check`). The deviation of one packing is the median of the
/// results that are there, and each packing takes the cycles that those of the results took; without results
/// it is what deck::Experience says. The core time follows from the speed of the results, else from
/// machine_speed().
///
/// The uncertainty is twice the scatter of what the results took about what the same rule would have said of
/// them, in logarithms: for the mean of the missing cases, and for what is learned from the results.
Forecast forecast(std::vector<CaseOverview> const& cases);

/// What a run has done and what is left of it, by the same rule (deck::work_of).
struct WorkOfRun {
    double left = 0;       ///< of the packings that are wanted and those that will probably follow
    double done = 0;       ///< in this run, by packings that have ended and by those under way
    double driven = 0;     ///< the same without their settling
    double core_time = 0;  ///< s, that the engines took for what was driven
    bool is_plain = true;  ///< deck::is_plain() for all of it

    /// Takes a packing as done.
    void add(prepare::PreparedCase const& prepared, bool has_settled, int cycles);
};

/// How long a run will probably still take; negative while that is not known.
struct TimeToGo {
    double wall = -1;  ///< s, as many cores as so far
    double core = -1;  ///< s of a core
};

/// From what was done so far, at the speed of this run.
/// @param elapsed  s
TimeToGo time_to_go(WorkOfRun const& work, double elapsed);

}  // namespace vibrotrough::campaign
