#include "measure/difference.hpp"

#include "measure/statistics.hpp"

#include <cmath>

namespace vibrotrough::measure {

std::optional<double> half_width_of_difference(CaseEstimate const& one, CaseEstimate const& other,
                                               double confidence) {
    if (!one.mean || !other.mean || !one.deviation || !other.deviation) return {};
    if (one.packings < 2 || other.packings < 2) return {};
    double const a = *one.deviation * *one.deviation / one.packings;
    double const b = *other.deviation * *other.deviation / other.packings;
    double const drift = std::hypot(one.drift, other.drift);
    if (a + b == 0) return drift;
    double const freedom = (a + b) * (a + b) / (a * a / (one.packings - 1) + b * b / (other.packings - 1));
    double const quantile = student_quantile(level_after_stopping(confidence), freedom);
    return std::hypot(quantile * std::sqrt(a + b), drift);
}

}  // namespace vibrotrough::measure
