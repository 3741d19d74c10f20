#pragma once

#include "prepare/prepared_case.hpp"

#include <kainjow/mustache.hpp>

namespace vibrotrough::deck {

/// The engine's seeds are primes above 10000.
int seed_number(int index);

/// What both decks show of one packing of a case.
kainjow::mustache::data describe(prepare::PreparedCase const& prepared, int packing);

}  // namespace vibrotrough::deck
