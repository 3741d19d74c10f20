#pragma once

#include "evaluate/packing.hpp"
#include "prepare/prepared_case.hpp"
#include "store/case_record.hpp"

#include <string>

namespace vibrotrough::evaluate {

/// The result of a case from its packings.
/// @param id        of the case
/// @param packings  at least one; those that the campaign's policy calls enough
store::CaseRecord evaluate_case(prepare::PreparedCase const& prepared, std::string const& id,
                                std::string const& engine_version, EvaluatedPackings packings);

}  // namespace vibrotrough::evaluate
