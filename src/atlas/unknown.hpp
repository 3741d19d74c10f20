#pragma once

#include "atlas/tables.hpp"

#include <optional>
#include <span>
#include <utility>

namespace vibrotrough::atlas {

/// The middle of an input's range, which stands for an input that is not known.
double middle_of(Input input);

/// Standard deviation, in velocity efficiency, that inputs may cause which are not known: the root mean
/// square over places of the whole atlas, at each of which they lie anywhere in their ranges while the others
/// stay.
/// @param fixed  an input that has this value at all places, instead of being unknown or varied
double sd_of_unknown(std::span<Input const> unknown,
                     std::optional<std::pair<Input, double>> const& fixed = {});

}  // namespace vibrotrough::atlas
