#include "store/case_record.hpp"

#include "prepare/numerical_errors.hpp"

#include <cmath>

namespace vibrotrough::store {

std::optional<double> CaseRecord::numerical_error() const {
    if (!estimate.mean) return {};
    return studied ? studied->error : prepare::numerical_errors(scenario).total();
}

std::optional<double> CaseRecord::whole_half_width() const {
    auto const numerics = numerical_error();
    if (!numerics || !estimate.half_width) return {};
    return std::hypot(*estimate.half_width, *numerics);
}

}  // namespace vibrotrough::store
