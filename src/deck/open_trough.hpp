#pragma once

#include "core/template.hpp"
#include "prepare/prepared_case.hpp"

namespace vibrotrough::deck {

/// What the templates say of an open trough: its feed, where grains have left it, and where they are
/// measured. Of other cases only that they have none.
/// @param packing  its number, on which the seed of the feed depends
void describe_open(core::TemplateData& data, prepare::PreparedCase const& prepared, int packing);

}  // namespace vibrotrough::deck
