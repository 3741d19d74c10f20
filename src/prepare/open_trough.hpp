#pragma once

#include "prepare/domain.hpp"
#include "prepare/prepared_case.hpp"

namespace vibrotrough::prepare {

/// Where the grains of an open trough are fed, measured and taken out. Grains, drive and time grid of the
/// case must be known.
OpenTrough open_trough(PreparedCase const& prepared);

}  // namespace vibrotrough::prepare
