#pragma once

#include <span>

#include <Eigen/Core>
#include <boost/math/distributions/students_t.hpp>

namespace vibrotrough::measure {

/// Values seen as an array of Eigen, without a copy.
inline Eigen::Map<Eigen::ArrayXd const> as_array(std::span<double const> values) {
    return {values.data(), static_cast<Eigen::Index>(values.size())};
}

/// The two-sided quantile of Student's t.
/// @param degrees_of_freedom  > 0, also fractional
inline double student_quantile(double confidence, double degrees_of_freedom) {
    boost::math::students_t const distribution(degrees_of_freedom);
    return boost::math::quantile(distribution, 0.5 + confidence / 2);
}

/// The level at which intervals of packings are computed so that they hold the truth with `confidence`,
/// although packings are added until the interval is narrow enough; see estimate_case().
double level_after_stopping(double confidence);

}  // namespace vibrotrough::measure
