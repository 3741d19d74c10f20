#pragma once

#include "core/template.hpp"
#include "prepare/prepared_case.hpp"

namespace vibrotrough::deck {

/// The engine's seeds are primes above 10000.
int seed_number(int index);

/// What both decks show of one packing of a case.
core::TemplateData describe(prepare::PreparedCase const& prepared, int packing);

}  // namespace vibrotrough::deck
