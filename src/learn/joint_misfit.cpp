#include "learn/joint_misfit.hpp"

#include <cmath>

namespace vibrotrough::learn {

std::optional<JointMisfit> joint_misfit(CalibrationModel const& model, std::span<double const> values,
                                        std::vector<MeasuredSpeed> const& speeds, double discrepancy,
                                        Eigen::MatrixXd const& common_errors) {
    JointMisfit sum{};
    Eigen::Index const given = common_errors.cols();
    Eigen::MatrixXd inner = Eigen::MatrixXd::Identity(given + 1, given + 1);
    Eigen::VectorXd weighted = Eigen::VectorXd::Zero(given + 1), common(given + 1);
    for (std::size_t i = 0; i < speeds.size(); ++i) {
        MeasuredSpeed const& measured = speeds[i];
        auto const answer = model(values, measured);
        if (!answer) return {};
        double const off = discrepancy * answer->trough_speed;
        double const variance =
            measured.uncertainty * measured.uncertainty + answer->sd * answer->sd + off * off;
        double const misfit = measured.speed - answer->speed;
        common.head(given) =
            common_errors.row(static_cast<Eigen::Index>(i)).transpose() * answer->trough_speed;
        common[given] = answer->common_sd;
        sum.chi_square += misfit * misfit / variance;
        sum.log_determinant += std::log(variance);
        weighted += common * (misfit / variance);
        inner += common * common.transpose() / variance;
    }
    Eigen::LLT<Eigen::MatrixXd> const root(inner);
    sum.chi_square -= root.matrixL().solve(weighted).squaredNorm();
    sum.log_determinant += 2 * root.matrixLLT().diagonal().array().log().sum();
    return sum;
}

Eigen::MatrixXd same_error(std::size_t measurements, double size) {
    return Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(measurements), size > 0 ? 1 : 0, size);
}

}  // namespace vibrotrough::learn
