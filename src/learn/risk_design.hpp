#pragma once

#include "learn/exciter.hpp"
#include "learn/plant.hpp"
#include "learn/speed_model.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::learn {

/// What a design is to be best at.
enum class Objective {
    fastest,               ///< the highest speed that is reached at the stated confidence
    gentlest_landing,      ///< the lowest speed of an impact on the trough
    least_machine_number,  ///< the least load of the structure
    least_power,           ///< the least power that the trough gives to the material
};

/// How exactly a machine is set and its material weighed: standard uncertainties, 0 when exact.
struct SettingErrors {
    double amplitude = 0;        ///< m
    double vibration_angle = 0;  ///< rad
    double bulk_density = 0;     ///< kg/m^3
};

/// What is known and wanted of a trough. The friction is not known exactly, and no model is exact.
struct DesignTask {
    theory::DriveSpace space;              ///< stroke, frequency, angles and the largest K and Gamma
    std::vector<DesignModel> models;       ///< at least one; all of them must reach the mass flow
    std::vector<DesignModel> beside = {};  ///< what these say of the machine is told; they decide nothing
    /// Proposes a machine, without a probability, where the models know no layer within the limits.
    std::optional<DesignModel> stand_in = {};
    /// Why no model knows the material, without a full stop; then `stand_in` proposes the machine.
    std::optional<std::string> unknown_material = {};
    KnownFriction friction;     ///< of the material on the trough
    SettingErrors errors = {};  ///< of what the machine is set to and the material weighs
    double bulk_density;        ///< kg/m^3, > 0
    double width;               ///< m, of the trough, > 0
    double length = 0;          ///< m, of the trough, for power and time; 0 when it is not known
    double mass_flow;           ///< kg/s, that is to be reached, > 0, with the surge
    double surge = 1;           ///< `mass_flow` over the nominal one, >= 1
    std::string material = {};  ///< its name and the source of its numbers, if it has one
    std::vector<DriveKind> drive_kinds = {};      ///< that are usual, to say which of them builds the machine
    std::optional<DriveKind> drive_kind = {};     ///< whose limits the space keeps, if one was asked for
    theory::Range depth{0.002, 0.1};              ///< m, of the layer
    std::optional<double> grain_diameter = {};    ///< m, if it is known
    std::optional<double> rolling_friction = {};  ///< coefficient of the grains, if it is known
    std::optional<double> grain_friction = {};    ///< coefficient of grain on grain, if it is known
    std::optional<MovedMachine> machine = {};     ///< trough, springs and exciter, if they are known
    std::optional<double> landing_speed;          ///< m/s, largest speed of an impact on the trough
    double confidence = 0.95;  ///< probability with which the mass flow is to be reached, in [0.5, 0.999]
    Objective objective = Objective::fastest;  ///< what to be best at
    /// Hz, of the drives that can be had, of which the best is chosen; empty: any within the space.
    std::vector<double> frequencies = {};
    std::vector<double> amplitudes = {};  ///< m, likewise, of the strokes that can be had
    bool tells_amplitude = false;  ///< messages give the amplitude, as the user did, and not the stroke
    bool tells_frequency = false;  ///< messages give the frequency, and not the speed of the drive

    /// A depth in diameters of the grains, if these are known. @param layer_depth  m
    std::optional<double> in_grains(double layer_depth) const {
        if (!grain_diameter) return {};
        return layer_depth / *grain_diameter;
    }
};

/// Why the speed of a layer is not known, by any of the models that decide, without a full stop; nothing
/// where it is. The friction counts with the central 95 % of its distribution.
std::optional<std::string> untested(DesignTask const& task, DesignLayer const& layer);

struct RiskDesign;

/// The machine for one of the speeds and strokes of the drive that can be had.
struct Choice {
    double frequency, amplitude;                    ///< Hz, m; 0 where it was free and no machine was found
    std::shared_ptr<RiskDesign const> design = {};  ///< nothing: no machine keeps the limits
    std::string why_none = {};                      ///< without a full stop
    int rank = 0;                                   ///< 1 for the best by the objective; 0 without a machine
};

/// What one uncertain input leaves open of the mass flow; see budget_of().
struct BudgetShare {
    std::string source;  ///< the input
    double sd;           ///< kg/s, standard deviation when it alone varies
    double gained;       ///< kg/s, that would be sure as well if it were known exactly
};

/// What one model says of a design.
struct ModelForecast {
    std::string model;    ///< its name
    double median_speed;  ///< m/s
    double sure_speed;    ///< m/s, reached with the stated confidence
    double sure_flow;     ///< kg/s, carried with the stated confidence at the design's depth
    /// kg/s, central 95 % interval of the mass flow at the design's depth; the first is not finite where the
    /// material may run away.
    double low_flow, high_flow;
    double median_flow;                  ///< kg/s
    double probability;                  ///< that the mass flow is reached
    std::vector<double> flow_quantiles;  ///< kg/s, at the shares of `quantile_shares`
    /// What the model says of the velocity efficiency at the median of the friction, with its own
    /// uncertainty; nothing when the material has no steady speed.
    std::optional<ModelEfficiency> efficiency;
    /// Why its probability and intervals may not be relied on, without a full stop: see RiskDesign.
    std::optional<std::string> untested = {};
    double flow_sd = 0;  ///< kg/s, standard deviation of the mass flow; not finite where it may run away
    std::vector<BudgetShare> budget = {};  ///< the largest share first; empty where nothing is uncertain
};

/// 2.5 %, 5 %, ..., 97.5 %: the shares of a distribution below the quantiles of a forecast.
std::vector<double> quantile_shares();

/// A machine for a task, and how sure it is.
struct RiskDesign {
    theory::Drive drive;                   ///< rounded to what a workshop sets
    double throw_number, machine_number;   ///< Gamma and K
    double depth;                          ///< m, of the layer that carries the mass flow at the confidence
    std::vector<ModelForecast> forecasts;  ///< one per model, in their order
    std::vector<ModelForecast> beside;     ///< of the models that decide nothing, where they know the drive
    double sure_speed;                     ///< m/s, reached with the stated confidence by all models
    double sure_flow;                      ///< kg/s, carried so surely by a layer of `depth`
    double probability;                    ///< that the mass flow is reached; the least of the models'
    /// Why none of these probabilities and intervals may be relied on, without a full stop: a model's error
    /// is not known there. They must not be shown then.
    std::optional<std::string> untested;
    double efficiency;  ///< velocity efficiency of the point mass at the median of the friction
    std::string mode;   ///< letters of its phases
    /// m/s, largest speed of an impact of the point mass on the trough at any friction within its central
    /// 99.7 %; 0 without flight.
    double landing_speed;
    double power_per_mass;  ///< W/kg, that the trough gives to the point mass at the median of the friction
    /// Whether the mass flow can be reached within the limits at the stated confidence, which must be known.
    bool feasible;
    /// m, of the trough that would carry the mass flow at the confidence with this drive and depth; only when
    /// the mass flow is not reached and some speed is sure.
    std::optional<double> width_needed;
    std::vector<Choice> choices;             ///< one for each of the task's frequencies and amplitudes
    std::vector<std::string> active_limits;  ///< what holds it back
    std::vector<std::string> warnings;       ///< where a model is known to be wrong, in whole sentences
};

/// Finds the drive and the depth of the layer that carry a mass flow with a stated probability.
///
/// The speed is uncertain in four ways: the friction has a distribution, a model may know its own
/// uncertainty (a learnt surface), each model misses a normal error, its discrepancy, and stroke, angle and
/// bulk density are not exact: these count as normal errors of the speed in proportion to theirs, taken at
/// the median of the friction. The speed that is reached with the stated confidence is a quantile of this
/// distribution, the least of all models'.
///
/// One search over drives and depths: first for the layer that carries most at the confidence, which does not
/// depend on how much is wanted; if it carries the mass flow, for the best by the objective of those that do,
/// on the thinnest layer that carries it. So a wider range never gives a worse machine, but
/// for a percent by which the search and the rounding may miss the best, and on a trough of
/// `width_needed` the same layer carries the mass flow. Where some layer within the limits is one at which
/// the models are tested, only such layers are proposed.
///
/// The drive is then rounded to steps of 1/min, 0.1 mm of stroke
/// and half a degree, or finer ones where these cost more than half a percent. Every limit is kept by
/// the rounded drive, and that of the landing speed at every friction in the central 99.7 % of its
/// distribution: the search keeps it at a few frictions, and adds the worst one until none is above the limit
/// (exchange method of semi-infinite programming, J.W. Blankenship and J.E. Falk, J. Optim. Theory Appl. 19
/// (1976) 261-281).
///
/// @throws std::invalid_argument when a limit is out of range, and when no drive keeps all of them: the
/// message names the limits in the way
/// @throws core::InputError when fewer than five draws of the friction lie beyond the confidence
RiskDesign design_with_risk(DesignTask const& task);

/// The same for a machine that is there: what the models say of it, with a layer of its own depth.
/// @param depth  m, > 0
RiskDesign judge_machine(DesignTask const& task, theory::Drive const& drive, double depth);

/// m/s, the largest speed of an impact of the plastic point mass at a drive; 0 without flight, infinite when
/// it runs away.
double landing_speed(theory::Drive const& drive, double friction);

}  // namespace vibrotrough::learn
