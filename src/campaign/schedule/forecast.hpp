#pragma once

#include "campaign/state/overview.hpp"

#include <string>
#include <vector>

namespace vibrotrough::campaign {

/// What a campaign would still cost.
struct Forecast {
    double speed = 0;       ///< grain-steps per second and core that the estimate rests on
    bool measured = false;  ///< `speed` and `cycles` come from the campaign's own results
    double cycles = 0;      ///< expected per packing
    double core_time = 0;   ///< s, of all packings that are missing
    std::vector<double>
        cases;  ///< s of a core per case, in the order of the plan; 0 where nothing is missing
};

/// Estimates the cost of what is missing: grain-steps of settling and of the expected cycles over the speed.
/// Speed and number of cycles are those of the results that are there, else 5e6 grain-steps per second and
/// core (LIGGGHTS 3.8.0, 600 to 5000 grains) and 40 cycles, of which 10 stand for the settling.
Forecast forecast(std::vector<CaseOverview> const& cases);

}  // namespace vibrotrough::campaign
