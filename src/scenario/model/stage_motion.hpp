#pragma once

#include "scenario/model/scenario.hpp"

#include <vector>

/// @file
/// How a trough moves whose drive has stages.

namespace vibrotrough::scenario {

/// A part of the motion of a trough: the ramp of a stage, or what follows it. With u from 0 to 1 over its
/// time, the displacement is (1 - u) D_from(phi) + u D_to(phi) in a ramp and D_to(phi) otherwise, where
/// D(phi) = X(phi) - X(0) for a motion X, and 0 for a trough that stands still. The angle phi is that of a
/// whole number of cycles, with a frequency that goes over linearly.
struct DrivePart {
    int stage;               ///< index of the stage, from 0
    bool ramp;               ///< whether it is a ramp
    int first_cycle;         ///< number of cycles before the part
    int cycles;              ///< at least 1
    double start;            ///< s, when it begins
    double time;             ///< s, how long it is
    double first_frequency;  ///< Hz, at its beginning
    double frequency;        ///< Hz, at its end
    DriveMotion from;        ///< of the stage before, for a ramp; empty for a standstill
    DriveMotion to;          ///< of the stage; empty for a standstill

    /// The angle phi at a share u of the time, rad.
    double angle(double share) const;
    /// Duration of one of its cycles, which in a ramp are equal shares of its time, s.
    double cycle_time() const { return time / cycles; }
};

/// The parts of all stages in their order.
std::vector<DrivePart> drive_parts(std::vector<Stage> const& stages);

/// Where the trough is and how fast.
struct TroughState {
    double x, z;    ///< m, displacement since the start of the run
    double vx, vz;  ///< m/s
};

/// The part at a time (s) after the start of the run; behind the last part, the last one.
/// @pre there is a part
DrivePart const& part_at(std::vector<DrivePart> const& parts, double time);

/// The trough at a time (s) after the start of the run; behind the last part, as at its end.
/// @pre there is a part
TroughState trough_at(std::vector<DrivePart> const& parts, double time);

/// The time at which a step of the engine ends, s. All cycles have the same number of steps.
double time_of_step(std::vector<DrivePart> const& parts, int steps_per_cycle, long step);

}  // namespace vibrotrough::scenario
