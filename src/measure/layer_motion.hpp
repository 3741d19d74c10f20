#pragma once

#include "measure/phase_series.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::measure {

/// What the analysis of a layer must be told.
struct LayerFacts {
    double mass;                  ///< kg
    double gravity_x, gravity_z;  ///< m/s^2 along and normal to the trough; gravity_z < 0
    double frequency;             ///< Hz, of the drive
    int discarded;                ///< cycles at the beginning to leave out
    int used;                     ///< the last cycle to use
};

/// Mean curves over one period of the layer's motion, 100 values per cycle. Value j is at phase 2 pi (j + 1)
/// / 100; forces are means over the interval that ends there. Standard deviations are over the periods.
/// `slip` and `sliding` have a gap, NaN, at phases at which no grain touches the floor.
struct PhaseCurves {
    std::vector<double> phase;         ///< rad
    std::vector<double> displacement;  ///< m, of the centre of mass against the trough since phase 0
    std::vector<double> height;        ///< m, of the centre of mass above the trough
    std::vector<double> velocity_x, velocity_z;                ///< m/s, of the centre of mass
    std::vector<double> trough_velocity_x, trough_velocity_z;  ///< m/s
    std::vector<double> normal_force, tangential_force;        ///< N, layer on trough
    std::vector<double> floor_force;  ///< N, the part of normal_force that the floor carries, not side walls
    std::vector<double> touching;     ///< grains that touch the floor
    std::vector<double> airborne;     ///< fraction of the periods in which nothing touches the trough
    std::vector<double> clearance;    ///< m, between floor and lowest grain; negative: overlap
    std::vector<double> slip;         ///< m/s, of the touching grains' surface on the floor, v - omega R
    std::vector<double> sliding;      ///< m/s, the same without rotation
    std::vector<double> energy_translation, energy_rotation;  ///< J
    std::vector<double> overlap;                              ///< m, largest of two grains, over all periods
    /// standard deviations, same units
    /// Standard deviations over the periods, in the units of the means.
    std::vector<double> displacement_deviation, height_deviation;
    /// Standard deviations over the periods, in the units of the means.
    std::vector<double> velocity_x_deviation, velocity_z_deviation;
    /// Standard deviations over the periods, in the units of the means.
    std::vector<double> normal_force_deviation, tangential_force_deviation;
    std::vector<double> touching_deviation;  ///< standard deviation over the periods
};

/// How the layer moves within the cycle. A number that does not exist (no flight, no slide) has no value.
struct LayerMotion {
    std::string mode;  ///< the bulk's mode in the theory's letters (layer_mode.hpp); empty without cycles
    int period_cycles = 0;                 ///< cycles after which the motion repeats, 1 to 8
    std::optional<double> take_off_phase;  ///< rad, of the longest flight, [0, 2 pi)
    std::optional<double> landing_phase;   ///< rad, above take_off_phase, not wrapped
    std::size_t landing_line = 0;          ///< of `curves`: the first behind the longest flight, if it lands
    double flight_number = 0;              ///< duration of the longest flight, cycles
    /// Largest rising speed of the centre of mass relative to the trough from landing to the next take-off,
    /// over the falling speed just before landing: e = max v_z,rel(after) / -v_z,rel(before), mean over all
    /// landings after flights of a tenth of a cycle or more; 0 when the layer lands and stays.
    std::optional<double> restitution;
    /// J per cycle: work of the trough (force on the layer times displacement) and of gravity, less the gain
    /// of kinetic energy.
    std::optional<double> dissipation;
    std::optional<double> floor_slip;  ///< m/s, mean over all touching grains
    /// |tangential| / normal force while the layer slides, landings apart: mu when all of it slides.
    std::optional<double> friction_ratio;
    /// Tangential over normal impulse while the layer lands, and the efficiency of a point mass under the
    /// layer's own normal force; see landing.hpp. No value without landings, and with side walls.
    std::optional<double> landing_friction;
    std::optional<double> efficiency_by_normal_force;  ///< velocity efficiency of a point mass under the
                                                       ///< normal force of the layer
    std::optional<double> largest_overlap;             ///< m, of two grains
    std::optional<double> largest_floor_overlap;       ///< m
    /// What the layer does to the machine, see reaction.hpp. No value without curves.
    std::optional<double> added_mass;    ///< kg
    std::optional<double> damping;       ///< kg/s
    std::optional<double> trough_power;  ///< W, of the trough on the layer
    PhaseCurves curves;                  ///< mean curves over one period
};

/// Cycles after which the height above the trough repeats: the first of 2 ... 8 whose squared differences are
/// below a quarter of those from cycle to cycle, else 1. A layer that skips cycles has 2 or more.
int period_of(PhaseSeries const& series, int discarded, int used);

/// An angle without its whole turns, rad, [0, 2 pi).
double within_turn(double angle);

/// The velocity of what moves periodically, from its 100 places per cycle: the derivative of the
/// trigonometric polynomial through them, exact for up to 49 harmonics.
std::vector<double> periodic_velocity(std::vector<double> const& places, double frequency);

/// Looks at the cycles after `discarded`, up to `used`.
LayerMotion layer_motion(PhaseSeries const& series, LayerFacts const& facts);

}  // namespace vibrotrough::measure
