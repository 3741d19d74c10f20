#pragma once

#include "learn/calibration.hpp"

#include <optional>
#include <span>
#include <vector>

// Internal to this room.
namespace vibrotrough::learn {

/// Measured speeds against a model, as one normal distribution.
struct JointMisfit {
    double chi_square;       ///< m^T C^-1 m of the misfits m and their covariance C
    double log_determinant;  ///< of C
};

/// The misfit of all speeds together; nothing where the model has no steady speed. The covariance is
/// diag(d) + c c^T, see calibrate(), so that (Sherman and Morrison)
///     m^T C^-1 m = sum m_i^2 / d_i - (sum c_i m_i / d_i)^2 / (1 + sum c_i^2 / d_i),
///     det C = prod d_i (1 + sum c_i^2 / d_i).
/// @param discrepancy, common_error  of the model, in velocity efficiency
std::optional<JointMisfit> joint_misfit(SpeedModel const& model, std::span<double const> values,
                                        std::vector<MeasuredSpeed> const& speeds, double discrepancy,
                                        double common_error);

}  // namespace vibrotrough::learn
