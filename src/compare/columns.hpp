#pragma once

#include "compare/comparison.hpp"

#include <nlohmann/json.hpp>

namespace vibrotrough::compare {

/// The columns of JSON and CSV: a contract with scripts. Unknown numbers are null.
nlohmann::ordered_json to_object(Row const& row);

/// efficiency_dem - efficiency_theory, when both are known.
std::optional<double> difference(Row const& row);

}  // namespace vibrotrough::compare
