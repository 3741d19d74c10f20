#pragma once

#include "prepare/prepared_case.hpp"
#include "view/frames.hpp"

#include <optional>

namespace vibrotrough::app {

/// The theory's periodic motion that a case is compared with, and what its numbers are in. None without a
/// period.
std::optional<view::TheoryMotion> point_mass_beside(prepare::PreparedCase const& prepared);

}  // namespace vibrotrough::app
