#pragma once

#include "theory/inputs.hpp"
#include "theory/rolling_layer.hpp"

#include <optional>
#include <vector>

namespace vibrotrough::theory {

/// How eta changes with one input.
struct Sensitivity {
    Input input;        ///< the input that is varied
    double value;       ///< of the input, in its unit
    double derivative;  ///< d eta / d input; at a change of mode the mean of both sides
    double elasticity;  ///< (input / eta) d eta / d input; 0 when eta is 0
};

/// Derivatives of eta with respect to every given input, by central differences with a relative step of 1e-5
/// (an absolute step of 1e-5 if the input is zero). Their error is about 1e-9 plus 1e-10 times the third
/// derivative.
/// @param rolling  the law of rolling layers; nothing: a point mass
/// @throws std::invalid_argument when the inputs are incomplete or the motion is not periodic
std::vector<Sensitivity> sensitivities(Inputs const& inputs, std::optional<RollingLaw> const& rolling = {});

}  // namespace vibrotrough::theory
