#pragma once

#include "learn/calibration.hpp"

#include <optional>
#include <span>
#include <vector>

// Internal to this module.
namespace vibrotrough::learn {

/// Measured speeds against a model, as one normal distribution.
struct JointMisfit {
    double chi_square;       ///< m^T C^-1 m of the misfits m and their covariance C
    double log_determinant;  ///< of C
};

/// The misfit of all speeds together; nothing where the model has no steady speed. The covariance is
/// D + U U^T with diagonal D and the common errors as the columns of U, see calibrate(), so that (Woodbury)
///     m^T C^-1 m = m^T D^-1 m - b^T A^-1 b with A = 1 + U^T D^-1 U and b = U^T D^-1 m,
///     det C = det D det A.
/// @param discrepancy    of the model, in velocity efficiency
/// @param common_errors  likewise: a row for each speed, and a column for each error
std::optional<JointMisfit> joint_misfit(CalibrationModel const& model, std::span<double const> values,
                                        std::vector<MeasuredSpeed> const& speeds, double discrepancy,
                                        Eigen::MatrixXd const& common_errors);

/// An error of the same size in all measurements, in velocity efficiency, as a column; none for 0.
Eigen::MatrixXd same_error(std::size_t measurements, double size);

}  // namespace vibrotrough::learn
