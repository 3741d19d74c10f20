#pragma once

#include "deck/deck.hpp"
#include "store/case_record.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace vibrotrough::campaign {

/// phases.csv of a packing; of rigid bodies with places that are integrated.
/// @throws as measure::read_phases
measure::PhaseSeries read_packing_phases(Scenario const& scenario, deck::Deck const& deck,
                                         std::filesystem::path const& folder);

/// Measures how the layer of a packing moves within the cycle, over the cycles that its mean is from, and
/// writes it into the record, whose estimate is there already.
/// @throws InputError when a file in the packing's folder is damaged
/// @throws MissingError when there is none
void measure_layer(store::PackingRecord& record, Scenario const& scenario, deck::Deck const& deck,
                   std::filesystem::path const& folder);

/// The mode that most packings have, the first of those that are equally frequent.
std::string common_mode(std::vector<store::PackingRecord> const& packings);

/// All that a packing's run wrote within its cycles, as one text for a digest; empty without phases.csv.
std::string layer_outputs(std::filesystem::path const& folder);

}  // namespace vibrotrough::campaign
