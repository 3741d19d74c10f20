#pragma once

#include "atlas/layer_mode.hpp"
#include "atlas/value.hpp"
#include "learn/atlas_design_model.hpp"
#include "theory/drive.hpp"
#include "theory/point_mass.hpp"

#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::learn {

/// A machine that exists, and the material on it as far as it is known.
struct ExistingMachine {
    theory::Drive drive;                         ///< as it runs
    Uncertain friction;                          ///< of the material on the trough
    KnownGrains grains = {};                     ///< of the material
    std::optional<double> depth = {};            ///< m, of the layer
    std::optional<double> width = {};            ///< m, of the trough
    std::optional<Uncertain> bulk_density = {};  ///< kg/m^3
};

/// What a model says of a machine.
struct MachinePrediction {
    double throw_number, machine_number;  ///< Gamma and K
    double trough_speed;                  ///< omega r cos(beta), m/s
    std::optional<double> point_mass;     ///< velocity efficiency; none without a mean speed
    std::string point_mass_mode;          ///< letters of its phases
    theory::Outcome point_mass_outcome;   ///< why there is none
    /// Velocity efficiency of the layer with the half-width of its 95 % interval, which holds what is not
    /// known of grains, depth and friction; none where no model knows the layer.
    std::optional<atlas::SurfaceValue> layer = {};
    /// Of the difference from the point mass, in velocity efficiency, what the rolling-layer law says that
    /// grains do which roll; none where the atlas does not decide.
    std::optional<double> by_rolling = {};
    std::optional<atlas::LikelyMode> mode = {};  ///< of the layer, by the atlas
    std::vector<atlas::Outside> outside = {};    ///< of the atlas: extrapolated, or not known at all
    std::vector<std::string> unknown = {};       ///< what nobody gave, for people
    std::optional<Uncertain> flow_per_speed =
        {};  ///< kg/m, mass flow over speed; none where not all is known
};

/// Predicts the conveying speed of a layer on a machine that exists: by the atlas of simulated layers, and by
/// the point mass for grains that do not roll (a rolling friction of 0.5 or more), with the error that
/// simulated layers of such grains show (validation/model_errors). What is not known is in the middle of what
/// was simulated, and what it may change widens the interval.
MachinePrediction predict_machine(ExistingMachine const& machine);

/// m, the sizes of grains for which the atlas has the stroke of a machine and, where it is known, the depth
/// of its layer; the first may be above the second: there are none.
theory::Range known_sizes(ExistingMachine const& machine);

}  // namespace vibrotrough::learn
