#include "learn/joint_misfit.hpp"

#include <cmath>

namespace vibrotrough::learn {

std::optional<JointMisfit> joint_misfit(SpeedModel const& model, std::span<double const> values,
                                        std::vector<MeasuredSpeed> const& speeds, double discrepancy,
                                        double common_error) {
    JointMisfit sum{};
    double common_misfit = 0, common_weight = 0;
    for (MeasuredSpeed const& measured : speeds) {
        auto const answer = model(values, measured);
        if (!answer) return {};
        double const off = discrepancy * answer->trough_speed;
        double const variance =
            measured.uncertainty * measured.uncertainty + answer->sd * answer->sd + off * off;
        double const misfit = measured.speed - answer->speed;
        double const common = std::hypot(answer->common_sd, common_error * answer->trough_speed);
        sum.chi_square += misfit * misfit / variance;
        sum.log_determinant += std::log(variance);
        common_misfit += common * misfit / variance;
        common_weight += common * common / variance;
    }
    sum.chi_square -= common_misfit * common_misfit / (1 + common_weight);
    sum.log_determinant += std::log1p(common_weight);
    return sum;
}

}  // namespace vibrotrough::learn
