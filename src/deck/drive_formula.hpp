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

}  // namespace vibrotrough::deck
