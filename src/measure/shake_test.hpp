#pragma once

#include "measure/phase_series.hpp"

#include <vector>

namespace vibrotrough::measure {

/// What a pen on the layer draws on the trough in each of the cycles first + 1 ... last: the largest less the
/// smallest displacement of the centre of mass against the trough, m. The pen's line begins at the end of the
/// cycle before, so that `first` must be 1 or more. Between its lines the pen follows the parabola through
/// three of them.
std::vector<double> pen_lines(PhaseSeries const& series, int first, int last);

/// How far the layer gets away from the trough in a cycle, mean over these cycles, m: a layer that creeps
/// draws longer lines than it slides.
double creep_per_cycle(PhaseSeries const& series, int first, int last);

}  // namespace vibrotrough::measure
