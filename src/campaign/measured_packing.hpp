#pragma once

#include "campaign/packing_outputs.hpp"
#include "campaign/state/case_state.hpp"
#include "deck/deck.hpp"
#include "measure/estimate.hpp"
#include "measure/phase_series.hpp"
#include "store/case_record.hpp"

#include <map>
#include <optional>
#include <string>

namespace vibrotrough::campaign {

/// A finished packing: how it was run, and what was measured in it.
struct MeasuredPacking {
    FinishedPacking run;
    store::PackingRecord record;
};

/// Packings of a case that this process measured itself, by number: their files need not be read again.
using MeasuredPackings = std::map<int, MeasuredPacking>;

/// The velocity efficiency of a series, measured as the scenario asks.
measure::SequentialEstimate estimate_series(scenario::Scenario const& scenario,
                                            measure::CycleSeries const& series);

/// Whether the mean is known as well as the scenario asks, so that the run may end.
bool enough_cycles(scenario::Scenario const& scenario, measure::CycleSeries const& series);

/// Measures a packing whose engine ended well, but for its wall time.
/// @param all     its cycles
/// @param phases  and within them, as packing_phases gives them
/// @throws InputError when its snapshots are damaged, or phases and cycles do not go together
/// @throws MissingError when there are none
store::PackingRecord measure_packing(scenario::Scenario const& scenario, deck::Deck const& deck,
                                     PackingOutputs const& outputs, measure::CycleSeries const& all,
                                     measure::PhaseSeries const& phases);

/// A packing of an earlier time or another process, from its folder; nothing when it is not finished.
/// @throws as measure_packing
std::optional<MeasuredPacking> read_measured_packing(PlannedCase const& planned, int packing);

}  // namespace vibrotrough::campaign
