#pragma once

#include "scenario/model/drive.hpp"

#include <string>
#include <vector>

namespace vibrotrough::deck {

/// A variable of the deck.
struct Formula {
    std::string name;        ///< without the prefix v_
    std::string expression;  ///< in the engine's language, m
};

/// The velocity of the trough along one axis as an expression of the engine. The mover adds velocity times
/// time step, so the velocity is chosen such that the position after each step is exactly X(t) - X(0).
struct DriveFormula {
    std::vector<Formula> terms;  ///< variables in `speed`, each with few harmonics because lines are limited
    std::string speed;           ///< expression of the velocity, m/s
};

/// The velocity that belongs to a Fourier series of the displacement.
/// @param terms  displacement along the axis
/// @param axis   "x" or "z", part of the names of the variables
DriveFormula drive_formula(std::vector<scenario::DriveTerm> const& terms, std::string const& axis);

/// The displacement D = X - X(0) that belongs to a Fourier series X, in the member `speed` of the result, m.
/// @param name   with which the names of the variables begin
/// @param angle  name of the variable with the angle, without the prefix v_
DriveFormula displacement_formula(std::vector<scenario::DriveTerm> const& terms, std::string const& name,
                                  std::string const& angle);

/// One axis of a record as the numbers of a `viblin` of the engine, each separated by blanks.
struct SineMover {
    std::string amplitudes;  ///< m
    std::string phases;      ///< rad
    std::string periods;     ///< s
};

/// The engine's sum of sines whose displacement after each step is that of a Fourier series. It adds
/// - a w sin(w t + p) dt in the step that ends at t. A sin(k phi + q) - A sin(k (phi - d) + q), with d the
/// phase of a step, is 2 A sin(k d / 2) cos(k phi + q - k d / 2), so that a = 2 A sin(k d / 2) / (k d) and p
/// = q - k d / 2 - pi / 2.
/// @param time_step  of the engine, s
SineMover sine_mover(std::vector<scenario::DriveTerm> const& terms, double time_step, int steps_per_cycle);

}  // namespace vibrotrough::deck
