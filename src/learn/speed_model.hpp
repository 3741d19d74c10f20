#pragma once

#include "learn/known_friction.hpp"
#include "learn/model_errors.hpp"
#include "learn/uncertain.hpp"
#include "theory/drive.hpp"

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::learn {

/// A layer on a vibrating trough: what a model of the conveying speed is asked about.
struct DesignLayer {
    theory::Drive drive;  ///< of the trough
    double depth;         ///< m, of the layer
};

/// A part of a model's own uncertainty: an input that is not known, such as the rolling friction.
struct OwnSource {
    std::string name;  ///< of the input, with its range when nobody gave it
    double sd;         ///< standard deviation, in velocity efficiency
};

/// What a model says of a layer.
struct ModelEfficiency {
    double efficiency;       ///< velocity efficiency
    double statistics_sd;    ///< standard deviation of its statistical uncertainty; 0 when exact
    double numerics_sd = 0;  ///< that of the numerical errors of the simulations on which it rests
    std::vector<OwnSource> sources = {};  ///< the parts of `statistics_sd` that come from known inputs

    /// Standard deviation of the model's own uncertainty: both together.
    double sd() const { return std::hypot(statistics_sd, numerics_sd); }
};

/// Where a layer lies among those that a model knows.
struct Whereabouts {
    double excess = -1;  ///< how far its drive lies outside, relatively; zero or less inside
    std::optional<std::string> why_not = {};  ///< it is not known there, without a full stop
};

/// How exactly a model is asked.
enum class Precision {
    near,  ///< nearly, in a fraction of the time where a model has such a way: so a machine is searched for
    exact,
};

/// A model of the conveying speed. The same question always has the same answer; a model may remember the
/// last one, so that it is not for several threads.
class SpeedModel {
  public:
    virtual ~SpeedModel() = default;
    /// The velocity efficiency of a layer at a friction; nothing when the material has no steady speed.
    virtual std::optional<ModelEfficiency> speed(DesignLayer const& layer, double friction,
                                                 Precision precision) = 0;
    /// The efficiency alone of speed(), nearly: for a model that then has less to do.
    virtual std::optional<double> near_efficiency(DesignLayer const& layer, double friction) {
        auto const value = speed(layer, friction, Precision::near);
        return value ? std::optional(value->efficiency) : std::nullopt;
    }
    /// @param depth  of the layer, in diameters of its grains, if it is known
    virtual Whereabouts where(theory::Drive const& drive, double friction,
                              std::optional<double> depth) const = 0;
    /// Takes out of drives and depths (m) those at which the model is not known; the depths may then be
    /// empty.
    /// @throws std::invalid_argument when no drive is left
    virtual void narrow(theory::DriveSpace& space, theory::Range& depth) const = 0;
};

/// A model by which a machine can be designed, and what is known of its error.
struct DesignModel {
    std::string name;  ///< e.g. "the point mass"
    /// Standard deviation of what it misses, in velocity efficiency, >= 0; nothing: as `errors` say.
    std::optional<double> discrepancy;
    std::span<ModelError const> errors = {};  ///< what simulated layers say of its error
    std::shared_ptr<SpeedModel> speeds = {};  ///< what it says
    std::string known_range = {};  ///< where it is known, for people; empty: everywhere, or told elsewhere
    bool is_point_mass = false;    ///< whether it is the theory alone
    bool is_slow = false;          ///< whether it has a faster way for Precision::near
    /// Whether the discrepancies of a calibrated friction replace `discrepancy`.
    bool uses_calibrated_discrepancy = false;
    std::vector<std::string> remarks = {};  ///< what speaks against it, in whole sentences

    /// As SpeedModel::speed().
    std::optional<ModelEfficiency> at(DesignLayer const& layer, double friction,
                                      Precision precision = Precision::exact) const {
        return speeds->speed(layer, friction, precision);
    }
    /// How far a drive is outside what the model knows, relatively; zero or less inside.
    double excess(theory::Drive const& drive) const { return speeds->where(drive, 0, {}).excess; }
    /// Standard deviation of what it misses at a drive; where nothing is known, the largest that is. What few
    /// layers tell is distributed as Student's t with as many degrees of freedom, whose tails are longer than
    /// those of a normal distribution: the standard deviation is so large that the two agree at the
    /// confidence.
    /// @param depth  of the layer, in diameters of its grains, if it is known
    /// @param confidence  one-sided; below usual_confidence the standard deviation is that of it
    double missed(theory::Drive const& drive, std::optional<double> depth,
                  double confidence = usual_confidence) const;
    /// Why its error is not known at a drive, a friction and a depth, without a full stop; nothing where it
    /// is. What simulated layers say of an error holds for depths in grains, which must then be known.
    std::optional<std::string> untested(theory::Drive const& drive, double friction,
                                        std::optional<double> depth) const;
};

/// Grains with so large a rolling friction, or a larger one, do not roll: the layers of
/// validation/model_errors that tell the error of the point mass have 0.5.
inline constexpr double least_friction_without_rolling = 0.5;

/// The point-mass theory, for grains that do not roll. @param discrepancy  nothing: as
/// validation/model_errors says
DesignModel point_mass_design_model(std::optional<double> discrepancy = {});

/// The law of rolling layers, where it has been tested. The grains' rolling friction is added to its dry
/// torque, which holds for layers in 194 of 207 cases within 1.96 of the errors of validation/model_errors
/// (validation/atlas, rolling friction of 0.03 to 0.2). What is not known of it is one of the sources.
/// @param rolling_friction  of the grains, >= 0; nothing: unknown_rolling_friction()
/// @param discrepancy       nothing: as validation/model_errors says
/// @param friction_looked_at  on the trough, at which it is looked at what the rolling friction changes
DesignModel rolling_layer_design_model(std::optional<Uncertain> const& rolling_friction = Uncertain{0},
                                       std::optional<double> discrepancy = {},
                                       double friction_looked_at = 0.3);

}  // namespace vibrotrough::learn
