#pragma once

#include "core/template.hpp"
#include "deck/deck.hpp"

namespace vibrotrough::deck {

/// A seed as the engine requires it: prime number `index` (from 0) above 10000.
int seed_number(int index);

/// The data of the templates of both decks of one packing.
core::TemplateData describe(prepare::PreparedCase const& prepared, PackingPlan const& packing);

/// Gravity as it acts on the trough.
void describe_gravity(core::TemplateData& data, scenario::Scenario const& scenario);

/// Gravity while the grains settle: in an open trough that leads downhill only its part normal to the trough,
/// because the first grains would roll away.
void describe_settling_gravity(core::TemplateData& data, scenario::Scenario const& scenario);

}  // namespace vibrotrough::deck
