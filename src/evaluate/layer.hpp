#pragma once

#include "evaluate/packing_files.hpp"
#include "measure/phase_series.hpp"
#include "prepare/prepared_case.hpp"
#include "store/case_record.hpp"

#include <string>
#include <vector>

namespace vibrotrough::evaluate {

/// phases.csv of a packing. The engine does not unwrap the positions of rigid bodies of several spheres:
/// theirs are integrated from their velocities.
/// @throws as measure::parse_phases
measure::PhaseSeries packing_phases(prepare::PreparedCase const& prepared, core::TextFile const& file);

/// Measures how the layer of a packing moves within the cycle, behind the packing's own start-up, and writes
/// it into the record, which holds the estimate of the packing alone. The start-up that the packings of a
/// case have in common is known later (evaluate_case); it may be another one.
/// @throws core::InputError when a file in the packing's folder is damaged
/// @throws core::MissingError when a file is missing
void measure_layer(store::PackingRecord& record, prepare::PreparedCase const& prepared,
                   PackingFiles const& files, measure::PhaseSeries const& series);

/// The mode that most packings have; of equally frequent ones, the first.
std::string common_mode(std::vector<store::PackingRecord> const& packings);

}  // namespace vibrotrough::evaluate
