#pragma once

#include "core/template.hpp"
#include "deck/check.hpp"
#include "prepare/prepared_case.hpp"

#include <vector>

namespace vibrotrough::deck {

/// What the templates say of an open trough: its feed, where grains have left it, and where they are
/// measured. Of other cases only that they have none.
/// @param packing  its number, on which the seed of the feed depends
void describe_open(core::TemplateData& data, prepare::PreparedCase const& prepared, int packing);

/// What check_filling() finds of a packing of a drive without stages.
inline constexpr char const* filling_item = "cycles until the open trough is full / cycles of a packing";

/// An open trough begins empty. What flows through it is measured when it is full, which the first packings
/// should be for at least half of their cycles. The expected speed is rough, hence a quarter more time.
void check_filling(std::vector<Finding>& findings, prepare::PreparedCase const& prepared);

}  // namespace vibrotrough::deck
