#pragma once

#include "theory/rolling_layer.hpp"

namespace vibrotrough::theory {

/// eta of a rolling layer with a soft landing after `cycles` cycles, the mean of the last one, by
/// Boost.Odeint. For tests only; it does not share code with the library.
double integrated_efficiency(RollingLayer const& layer, int cycles);

}  // namespace vibrotrough::theory
