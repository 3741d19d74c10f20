#pragma once

#include "core/outcome.hpp"
#include "measure/case_estimate.hpp"
#include "measure/cycle_series.hpp"
#include "measure/estimate.hpp"
#include "measure/layer_motion.hpp"
#include "measure/layer_profiles.hpp"
#include "measure/open_flow.hpp"
#include "measure/screening.hpp"
#include "prepare/point_mass.hpp"
#include "scenario/model/scenario.hpp"

#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::store {

/// One packing's run and what was measured in it.
struct PackingRecord {
    int seed;             ///< of the random positions of the grains
    int steps_per_cycle;  ///< of the engine
    double time_step;     ///< of the engine, s
    double mass;          ///< kg, of all grains
    double wall_time;     ///< s, of the engine
    double core_time;     ///< s, processor time of the engine, all ranks
    /// Velocity efficiency with which all grains started; none when they started at rest.
    std::optional<double> start_efficiency;
    measure::CycleSeries series;        ///< the cycles used (what the engine wrote beyond them is left out)
    std::vector<double> efficiency;     ///< velocity efficiency of cycle 1 ... n
    measure::PackingEstimate estimate;  ///< of `efficiency`
    std::string deck;                   ///< in.liggghts
    measure::LayerMotion motion;        ///< within the cycle, behind the packing's own start-up
    measure::Profiles profiles;         ///< of the same cycles
    measure::Surface surface;           ///< of the layer in the same cycles
    measure::OpenFlow open;             ///< of an open trough
    measure::Screening screening;       ///< of a screen
    std::optional<double> granular_temperature;  ///< m^2/s^2, see measure/granular_temperature.hpp
    std::optional<double> segregation;        ///< of the first of [[materials]], see measure/segregation.hpp
    std::optional<double> material_lead;      ///< its velocity efficiency less that of the grains
    std::optional<double> stage_speed;        ///< m/s, see store/stage_quantities.hpp
    std::optional<double> time_to_speed;      ///< s, pseudo-value of the packing
    std::optional<double> stopping_distance;  ///< m
};

/// Where and with what a result was made.
struct Provenance {
    std::string program_version;     ///< of Vibrotrough
    std::string git_commit;          ///< that Vibrotrough was built from
    std::string engine_version;      ///< of LIGGGHTS
    std::string engine_certificate;  ///< JSON; empty when the engine was not probed
    std::string host;                ///< name of the machine
    std::string started;             ///< ISO 8601, UTC
    std::string finished;            ///< ISO 8601, UTC
};

/// A finished case: everything that result.h5 holds.
struct CaseRecord {
    std::string id;                       ///< of the case
    scenario::Scenario scenario;          ///< its input
    std::string scenario_toml;            ///< to_toml(scenario)
    core::Outcome outcome;                ///< one of those that has_result() names
    measure::CaseEstimate estimate;       ///< of velocity efficiency
    std::vector<PackingRecord> packings;  ///< in the order of their numbers
    Provenance provenance;                ///< of the result
    std::string layer_mode;               ///< of most packings, see measure::LayerMotion
    /// Numerical error of the velocity efficiency that 'vibrotrough convergence' found for this case, >= 0;
    /// in place of what is known beforehand, and not in result.h5.
    std::optional<double> studied_error = {};
    /// What the theory says of the case, for campaign.h5; not in result.h5, which holds what was measured.
    prepare::PointMassTheory theory = {};

    /// The numerical error of the velocity efficiency: the one that was studied, else the bound that is known
    /// beforehand (prepare::numerical_errors). None when there is no mean, and for a rigid block, of whose
    /// contact no bound is known.
    std::optional<double> numerical_error() const;

    /// The half-width of the velocity efficiency for statistics and numerics together, as far as the latter
    /// are known. None when the statistics are unbounded.
    std::optional<double> whole_half_width() const;
};

}  // namespace vibrotrough::store
