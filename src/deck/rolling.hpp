#pragma once

#include "core/template.hpp"
#include "prepare/prepared_case.hpp"

namespace vibrotrough::deck {

/// A line of rolling.csv is written at every third line of phases.csv, so that each phase is reached once in
/// three cycles: 3 has no factor in common with the 100 phases of a cycle.
constexpr int rolling_stride = 3;

/// Sets the data of the template `rolling`: what measure.rolling asks for. The first deck of a packing does
/// not need it and is shared by cases with and without it.
void describe_rolling(core::TemplateData& data, prepare::PreparedCase const& prepared);

}  // namespace vibrotrough::deck
