#pragma once

#include "atlas/value.hpp"
#include "theory/efficiency.hpp"
#include "theory/inputs.hpp"
#include "theory/rolling_layer.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// @file
/// What the page shows of a machine. All physics is that of src/theory, the atlas of simulated layers that of
/// src/atlas; what the models miss is that of src/learn.

namespace vibrotrough::page {

/// What is set on the page, in the units of its fields.
enum class Setting : std::size_t {
    stroke_mm,
    rpm,
    vibration_angle_deg,
    inclination_deg,
    friction,
    friction_band,
    rolling_friction,
    grain_mm,
    depth_mm,
    width_mm,
    bulk_density,
};
inline constexpr std::size_t setting_count = 11;  ///< Number of settings.

/// The names of the settings in their order.
std::array<char const*, setting_count> const& setting_names();

/// A value for each setting.
struct Settings {
    std::array<double, setting_count> value;  ///< in the order of Setting
    /// The value of one.
    double operator[](Setting setting) const { return value[static_cast<std::size_t>(setting)]; }
    /// Whether all values are the same.
    bool operator==(Settings const&) const = default;
    /// The same with another value of one setting.
    Settings with(Setting setting, double other) const;

    /// The inputs of the theory.
    theory::Inputs inputs() const;
    /// The same at another friction.
    theory::Inputs inputs(double friction) const;
    /// Depth of the layer in diameters of its grains.
    double depth_in_grains() const;
    /// kg/m: the mass of the layer on a length of the trough of 1 m.
    double mass_per_length() const;
};

/// Which model the page's answer is from.
enum class Model {
    rolling_layer,  ///< grains that roll, freely or against friction
    point_mass,     ///< grains that hardly roll
    atlas,          ///< the atlas of simulated layers, wherever it has the layer
};

/// How far an answer has been tested.
enum class Trust {
    tested,    ///< within the tested range of its model
    reaching,  ///< outside, but simulated layers show how far the model is off
    unknown,   ///< how far the model is off is not known, or the material runs away
};

/// A speed in m/s with what follows from it.
struct Speed {
    double efficiency;  ///< eta
    double speed;       ///< m/s; NaN where there is none
    double low,
        high;     ///< m/s: the band of the friction, widened by what the model misses; NaN where not known
    double flow;  ///< t/h of the whole trough
    double flow_low, flow_high;  ///< t/h, from low and high
    theory::ModeCode mode;       ///< phases of a period; 0 for none
};

/// What is answered fast enough to follow a slider.
struct Answer {
    double throw_number;     ///< Gamma
    double machine_number;   ///< K = omega^2 r / g
    double trough_speed;     ///< omega r cos(beta), m/s
    double depth_in_grains;  ///< of the layer
    double rule_speed;       ///< m/s by a maker's rule of thumb; NaN when the trough is not level
    double rule_flow;        ///< t/h that follow from it
    Speed mass, layer;       ///< of the point mass and of the rolling-layer law
    Speed atlas;             ///< of the atlas; NaN outside of it
    Speed best;              ///< of the model that fits these grains
    Model model;             ///< that model
    Trust trust;             ///< how far it has been tested
};

/// Answers many settings one after another.
class Machines {
  public:
    /// @throws std::invalid_argument when a setting has no sense
    Answer operator()(Settings const& settings);

    /// Gets the atlas ready, which takes longer than a first answer may: answers before that are those
    /// outside of it.
    void prepare_atlas();

    /// Efficiency and mode of a rolling layer of grains with a rolling friction; without one, of a point
    /// mass.
    theory::Efficiency efficiency(theory::PointMass const& point, std::optional<double> rolling_friction);

  private:
    Speed speed(Settings const& settings, bool rolling);
    Speed atlas_speed(Settings const& settings);

    Answer answered(Settings const& settings);

    std::optional<std::pair<Settings, Answer>> last_;
    std::optional<int> layers_;  ///< of the atlas, when its surface is ready
    theory::EfficiencySolver mass_;
    std::optional<std::pair<double, theory::RollingLayerSolver>> layer_;  ///< the last, by rolling friction
};

/// The rolling layer of these grains.
theory::RollingLayer layer_of(Settings const& settings);

/// What needs the phases of the point mass.
struct Landing {
    double impact_speed;    ///< m/s, largest speed relative to the trough at a landing; 0 without a flight
    double power_per_area;  ///< W/m^2 of trough, given to the layer
};

/// @throws std::invalid_argument when the motion has no period
Landing landing(Settings const& settings);

/// A motion in SI units at equally spaced times over its period.
struct Frame {
    double time;                ///< s
    double kind;                ///< number of the PhaseKind
    double trough_x, trough_y;  ///< m, displacement of the trough along itself and normal to it
    double travel;              ///< m, of the material relative to the trough
    double gap;                 ///< m
    double normal_force;        ///< N/kg
    double tangential_force;    ///< N/kg, positive forwards
};

/// @throws std::invalid_argument when the motion has no period
std::vector<Frame> frames(Settings const& settings, bool rolling, int count);

/// Why the answer is not one that has been tested; nothing for Trust::tested.
std::optional<std::string> untested(Settings const& settings, Answer const& answer);

/// What of the layer the atlas does not cover; empty inside of it.
std::vector<atlas::Outside> outside_atlas(Settings const& settings);

/// What is unusual about a machine, a sentence each.
std::vector<std::string> unusual(Settings const& settings, Answer const& answer);

}  // namespace vibrotrough::page
