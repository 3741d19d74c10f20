#pragma once

#include "core/template.hpp"
#include "prepare/prepared_case.hpp"

namespace vibrotrough::deck {

/// A seed as the engine requires it: prime number `index` (from 0) above 10000.
int seed_number(int index);

/// The data of the templates of both decks of one packing.
/// @param packing  number of the packing, from 1
core::TemplateData describe(prepare::PreparedCase const& prepared, int packing);

}  // namespace vibrotrough::deck
