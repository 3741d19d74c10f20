#pragma once

#include "core/template.hpp"
#include "deck/deck.hpp"

namespace vibrotrough::deck {

/// A seed as the engine requires it: prime number `index` (from 0) above 10000.
int seed_number(int index);

/// The data of the templates of both decks of one packing.
core::TemplateData describe(prepare::PreparedCase const& prepared, PackingPlan const& packing);

}  // namespace vibrotrough::deck
