#pragma once

#include "evaluate/packing_files.hpp"
#include "measure/phase_series.hpp"
#include "prepare/prepared_case.hpp"
#include "store/case_record.hpp"

namespace vibrotrough::evaluate {

/// Measures the contacts at the floor of a packing whose case asks for them, over the cycles that its mean is
/// taken from, and writes them into the record, which holds the motion of the layer already. When rolling.csv
/// is missing, cut or damaged, the record says so in one line and keeps all other results.
void measure_rolling(store::PackingRecord& record, prepare::PreparedCase const& prepared,
                     PackingFiles const& files, measure::PhaseSeries const& phases);

/// The same for a packing that was measured before: rolling.csv must also be what it was then.
void hold_to_marker(store::PackingRecord& record, PackingFiles const& files, PackingMarker const& marker);

}  // namespace vibrotrough::evaluate
