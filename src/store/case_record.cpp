#include "store/case_record.hpp"

#include "prepare/numerical_errors.hpp"

#include <cmath>

namespace vibrotrough::store {

std::optional<double> CaseRecord::numerical_error() const {
    if (!estimate.mean) return {};
    if (has_given_length(scenario)) return {};  // they are known for steady drives and layers
    if (studied_error) return studied_error;
    if (scenario.layer.block != scenario::Block::none) return {};
    return prepare::numerical_errors(scenario).total();
}

std::optional<double> CaseRecord::whole_half_width() const {
    if (!estimate.mean || !estimate.half_width) return {};
    return std::hypot(*estimate.half_width, numerical_error().value_or(0));
}

}  // namespace vibrotrough::store
