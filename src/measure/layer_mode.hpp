#pragma once

#include <span>
#include <string>
#include <vector>

namespace vibrotrough::measure {

/// What the mode is read from: mean curves over one period of the layer's motion, evenly spaced, at least 3
/// values. Values are of the end of each interval, forces are means over it. Scaled to be pure numbers.
struct ModeCurves {
    std::span<double const> slip;  ///< velocity along the trough relative to it, over omega r cos(beta)
    std::span<double const> normal_force;  ///< of the floor, over the layer's weight, m g cos(alpha)
    double step;                           ///< rad, omega times the interval
};

/// A stretch of the period in which the layer does one thing.
struct ModePhase {
    std::string letter;  ///< F, P, N, R, P' or N' as in the theory
    int first, length;   ///< intervals, counted on from the first one over the period's end
};

// Thresholds. The theory's phases are exact; a layer's curves are means of noisy ones.
/// In flight the trough carries less than this of the layer's weight: what a few loose grains can carry.
constexpr double flight_force = 0.05;
/// A contact that gives less than this of the momentum of a cycle, weight times T, is no landing: some stray
/// grains come down before the layer does.
constexpr double stray_impulse = 0.01;
/// A layer slower than this against the trough rests, if it also does not pass through zero: a layer that
/// shears and rolls a little is never quite still.
constexpr double rest_slip = 0.03;
/// Passing through zero is faster than this (change of slip per radian); a slide's is of order 1.
constexpr double rest_change = 0.06;
/// A phase shorter than this many intervals (7 degrees of 100 per cycle) belongs to its neighbour.
constexpr int shortest_phase = 2;

/// The bulk's phases in order, starting at the take-off of the longest flight, without flight at the first
/// slide; a layer that always rests has the one phase R.
std::vector<ModePhase> mode_phases(ModeCurves const& curves);

/// Their letters, e.g. "FN'P".
std::string mode_name(std::vector<ModePhase> const& phases);

}  // namespace vibrotrough::measure
