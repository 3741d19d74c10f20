#pragma once

#include "scenario/model/drive.hpp"

#include <string>
#include <vector>

namespace vibrotrough::deck {

/// A variable of the deck.
struct Formula {
    std::string name;
    std::string expression;
};

/// The trough's velocity along one axis in the engine's words: what the mover must be told so that the
/// position after each step is X(t) - X(0).
struct DriveFormula {
    std::vector<Formula> terms;  ///< variables that `speed` uses: few harmonics each, for the engine's lines
    std::string speed;           ///< m/s
};

/// @param axis  "x" or "z", part of the variables' names
DriveFormula drive_formula(std::vector<scenario::DriveTerm> const& terms, std::string const& axis);

}  // namespace vibrotrough::deck
