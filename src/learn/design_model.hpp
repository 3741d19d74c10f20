#pragma once

#include "learn/known_friction.hpp"
#include "learn/model_errors.hpp"
#include "learn/uncertain.hpp"
#include "theory/drive.hpp"
#include "theory/rolling_layer.hpp"

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::learn {

/// A layer on a vibrating trough: what a model of the conveying speed is asked about.
struct DesignLayer {
    theory::Drive drive;  ///< of the trough
    double depth;         ///< m, of the layer
};

/// What a model says of a layer.
struct ModelEfficiency {
    double efficiency;       ///< velocity efficiency
    double statistics_sd;    ///< standard deviation of its statistical uncertainty; 0 for an exact theory
    double numerics_sd = 0;  ///< that of the numerical errors of the simulations on which it rests

    /// Standard deviation of the model's own uncertainty: both together.
    double sd() const { return std::hypot(statistics_sd, numerics_sd); }
};

/// A part of a model's own uncertainty: an input that is not known, such as the rolling friction.
struct OwnSource {
    std::string name;  ///< of the input, with its range when nobody gave it
    double sd;         ///< standard deviation, in velocity efficiency
};

/// A model of the conveying speed, by which a machine can be designed.
struct DesignModel {
    std::string name;  ///< e.g. "the point mass"
    /// Standard deviation of what it misses, in velocity efficiency, >= 0; nothing: as `errors` say.
    std::optional<double> discrepancy;
    std::span<ModelError const> errors = {};  ///< what simulated layers say of its error
    /// The velocity efficiency of a layer at a friction; nothing when the material has no steady speed.
    std::function<std::optional<ModelEfficiency>(DesignLayer const&, double friction)> at = {};
    /// The same in a fraction of the time, nearly: by this a machine is searched for. Empty: `at` is fast.
    std::function<std::optional<ModelEfficiency>(DesignLayer const&, double friction)> nearly_at = {};
    /// The parts of the statistical uncertainty that `at` gives which are those of known inputs; may be
    /// empty.
    std::function<std::vector<OwnSource>(DesignLayer const&)> sources = {};
    /// The drives of a space at which the model is known. @throws std::invalid_argument when there are none
    std::function<theory::DriveSpace(theory::DriveSpace)> narrowed = {};
    theory::Range depths{0, 1e3};  ///< m, of the layers at which the model is known
    /// How far a drive is outside what the model knows, relatively; zero or less inside.
    std::function<double(theory::Drive const&)> excess = {};
    std::string known_range = {};  ///< where it is known, for people; empty: everywhere, or told elsewhere
    bool is_point_mass = false;    ///< whether it is the theory alone
    /// Whether the discrepancies of a calibrated friction replace `discrepancy`.
    bool uses_calibrated_discrepancy = false;
    /// Further reasons why its error is not known, see untested(); empty: none.
    std::function<std::optional<std::string>(theory::Drive const&, double friction,
                                             std::optional<double> depth)>
        outside = {};
    std::vector<std::string> remarks = {};  ///< what speaks against it, in whole sentences

    /// `nearly_at`, or `at` where that is fast.
    std::optional<ModelEfficiency> quickly_at(DesignLayer const& layer, double friction) const {
        return nearly_at ? nearly_at(layer, friction) : at(layer, friction);
    }
    /// Standard deviation of what it misses at a drive; where nothing is known, the largest that is.
    /// @param depth  of the layer, in diameters of its grains, if it is known
    double missed(theory::Drive const& drive, std::optional<double> depth) const;
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
/// torque, which holds for layers in 175 of 187 cases within 1.96 of the errors of validation/model_errors
/// (validation/atlas, rolling friction of 0.03 to 0.2). What is not known of it is one of the `sources`.
/// @param rolling_friction  of the grains, >= 0; nothing: unknown_rolling_friction()
/// @param discrepancy       nothing: as validation/model_errors says
/// @param friction_looked_at  on the trough, at which it is looked at what the rolling friction changes
DesignModel rolling_layer_design_model(std::optional<Uncertain> const& rolling_friction = Uncertain{0},
                                       std::optional<double> discrepancy = {},
                                       double friction_looked_at = 0.3);

/// The speed of a material without slip on a level or inclined trough, as guidelines such as VDI 2333
/// compute it: it moves with the trough while it touches it and flies for n cycles:
/// v = g n^2 / (2 f) (cos(alpha) cot(beta) - sin(alpha)), with n from the throw number (at most one cycle).
/// Zero when the material is not thrown. m/s. (vibrationsfoerdertechnik.de, on VDI 2333, says which
/// assumptions are made.)
double speed_without_slip(theory::Drive const& drive);

/// How many times as fast as the theory layers of spheres that roll were simulated at a throw number:
/// validation/why_theory_fails and rolling_layer, level, tan(beta) = 0.5, friction 0.23. Nothing outside the
/// throw numbers 1.2 to 2.3.
std::optional<double> factor_of_rolling_layers(double throw_number);

}  // namespace vibrotrough::learn
