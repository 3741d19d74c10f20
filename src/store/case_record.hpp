#pragma once

#include "core/outcome.hpp"
#include "measure/cycle_series.hpp"
#include "measure/estimate.hpp"
#include "measure/layer_motion.hpp"
#include "measure/layer_profiles.hpp"
#include "scenario/model/scenario.hpp"

#include <string>
#include <vector>

namespace vibrotrough::store {

/// One packing's run and what was measured in it.
struct PackingRecord {
    int seed;
    int steps_per_cycle;
    double time_step;                   ///< s
    double mass;                        ///< kg, of all grains
    double wall_time;                   ///< s, of the engine
    measure::CycleSeries series;        ///< the cycles used (what the engine wrote beyond them is left out)
    std::vector<double> efficiency;     ///< velocity efficiency of cycle 1 ... n
    measure::PackingEstimate estimate;  ///< of `efficiency`
    std::string deck;                   ///< in.liggghts
    measure::LayerMotion motion;        ///< within the cycle, over the cycles kept
    measure::Profiles profiles;         ///< of the same cycles
    measure::Surface surface;
};

/// Where and with what a result was made.
struct Provenance {
    std::string program_version;
    std::string git_commit;
    std::string engine_version;
    std::string engine_certificate;  ///< JSON; empty when the engine was not probed
    std::string host;
    std::string started;   ///< ISO 8601, UTC
    std::string finished;  ///< ISO 8601, UTC
};

/// A finished case: everything that result.h5 holds.
struct CaseRecord {
    std::string id;
    scenario::Scenario scenario;
    std::string scenario_toml;       ///< to_toml(scenario)
    core::Outcome outcome;           ///< finished, not_steady or not_precise
    measure::CaseEstimate estimate;  ///< of velocity efficiency
    std::vector<PackingRecord> packings;
    Provenance provenance;
    std::string layer_mode;  ///< of most packings, see measure::LayerMotion
};

}  // namespace vibrotrough::store
