#pragma once

#include <span>
#include <string>
#include <vector>

namespace vibrotrough::measure {

/// The curves from which the mode is determined: mean values over one period of the layer's motion, evenly
/// spaced, at least 3. Velocities are those at the end of each interval and forces are means over it. All are
/// dimensionless.
struct ModeCurves {
    std::span<double const>
        slip;  ///< velocity along the trough relative to the trough, over omega r cos(beta)
    std::span<double const>
        normal_force;  ///< normal force of the floor over the layer's weight m g cos(alpha)
    double step;       ///< rad, omega times the length of the interval
};

/// A phase of the layer's motion.
struct ModePhase {
    std::string letter;  ///< F, P, N, R, P' or N' as in the theory
    int first, length;   ///< first interval and number of intervals; a phase can continue beyond the end of
                         ///< the period
};

// Thresholds. They are needed because the curves of a layer are means of noisy curves, whereas the theory's
// phases are exact.
/// The layer is in flight if the trough carries less than this fraction of its weight, which a few loose
/// grains can carry.
constexpr double flight_force = 0.05;
/// A contact is not a landing if its impulse is less than this fraction of the weight times T: some stray
/// grains come down before the layer does.
constexpr double stray_impulse = 0.01;
/// A layer rests if its slip is slower than this and does not pass through zero: a layer that shears and
/// rolls a little is never completely at rest.
constexpr double rest_slip = 0.03;
/// The slip passes through zero if it changes faster than this (per radian); in a slide the change is of
/// order 1.
constexpr double rest_change = 0.06;
/// A phase shorter than this number of intervals (7 degrees at 100 per cycle) is merged with its neighbour.
constexpr int shortest_phase = 2;

/// The phases of the layer as a whole in order, starting at the take-off of the longest flight, or at the
/// first slide if there is no flight. A layer that always rests has the single phase R.
std::vector<ModePhase> mode_phases(ModeCurves const& curves);

/// The mode: the letters of the phases, e.g. "FN'P".
std::string mode_name(std::vector<ModePhase> const& phases);

}  // namespace vibrotrough::measure
