#pragma once

#include "measure/phase_series.hpp"

#include <vector>

namespace vibrotrough::measure {

/// The range (largest minus smallest value) of the displacement of the centre of mass relative to the trough
/// in each of the cycles first + 1 ... last, m. It corresponds to the length of the line that a pen fixed to
/// the layer would draw on the trough. Each cycle includes the last line of the previous one, so that `first`
/// must be at least 1. Turning points between lines are found with the parabola through three lines.
std::vector<double> relative_displacement_ranges(PhaseSeries const& series, int first, int last);

/// The mean drift of the layer relative to the trough per cycle over these cycles, m. With drift, the range
/// of the displacement is larger than the length of a slide.
double creep_per_cycle(PhaseSeries const& series, int first, int last);

}  // namespace vibrotrough::measure
