#pragma once

#include "campaign/packing_outputs.hpp"
#include "deck/deck.hpp"
#include "store/case_record.hpp"

#include <string>
#include <vector>

namespace vibrotrough::campaign {

/// phases.csv of a packing; of rigid bodies with places that are integrated.
/// @throws as measure::parse_phases
measure::PhaseSeries packing_phases(scenario::Scenario const& scenario, deck::Deck const& deck,
                                    core::TextFile const& file);

/// Measures how the layer of a packing moves within the cycle, over the cycles that its mean is from, and
/// writes it into the record, whose estimate is there already.
/// @throws InputError when a file in the packing's folder is damaged
/// @throws MissingError when there is none
void measure_layer(store::PackingRecord& record, scenario::Scenario const& scenario, deck::Deck const& deck,
                   PackingOutputs const& outputs, measure::PhaseSeries const& series);

/// The mode that most packings have, the first of those that are equally frequent.
std::string common_mode(std::vector<store::PackingRecord> const& packings);

}  // namespace vibrotrough::campaign
