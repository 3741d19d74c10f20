#pragma once

#include "theory/inputs.hpp"

#include <vector>

namespace vibrotrough::theory {

/// How eta answers to one input.
struct Sensitivity {
    Input input;        ///< the input that is varied
    double value;       ///< of the input
    double derivative;  ///< d eta / d input; the mean of both sides at a mode change
    double elasticity;  ///< (input / eta) d eta / d input; 0 when eta is 0
};

/// Derivatives of eta by every input that is given, by central differences of relative step 1e-5 (1e-5 where
/// the input is zero); their error is about 1e-9 plus 1e-10 of the third derivative.
/// @throws std::invalid_argument when the inputs are not complete or the motion does not settle
std::vector<Sensitivity> sensitivities(Inputs const& inputs);

}  // namespace vibrotrough::theory
