#include "atlas/surface.hpp"

#include <cmath>

#include <boost/math/distributions/binomial.hpp>
#include <fmt/format.h>

namespace vibrotrough::atlas {
namespace {

/// A surface whose Q2 is below this does not predict.
constexpr double least_q2 = 0.5;

}  // namespace

SurfaceQuality Surface::quality() const {
    std::vector<std::vector<inference::ProcessValue>> left_out;
    for (auto const& process : others_) left_out.push_back(process.leave_one_out());
    auto const& values = process_.data().values;
    double const mean = values.mean();
    double errors = 0, about_mean = 0;
    SurfaceQuality q{
        static_cast<int>(values.size()), 0, 0, 0, 0, process_.hyperparameters().extra_noise, extra_noise_p_};
    for (Eigen::Index i = 0; i < values.size(); ++i) {
        std::vector<inference::ProcessValue> parts;
        for (auto const& one : left_out) parts.push_back(one[static_cast<std::size_t>(i)]);
        auto const [predicted, sd] = inference::mixture(parts);
        double const error = values(i) - predicted;
        errors += error * error;
        about_mean += std::pow(values(i) - mean, 2);
        q.covered += std::abs(error) <= deviations_in_half_width * sd ? 1 : 0;
    }
    q.q2 = about_mean > 0 ? 1 - errors / about_mean : 0;
    boost::math::binomial const band(q.points, 0.95);
    q.least_covered = static_cast<int>(std::floor(boost::math::quantile(band, 0.025)));
    q.most_covered = static_cast<int>(std::ceil(boost::math::quantile(boost::math::complement(band, 0.025))));
    return q;
}

std::vector<std::string> Surface::doubts() const {
    SurfaceQuality const quality = this->quality();
    std::vector<std::string> doubts;
    if (quality.q2 < least_q2) {
        doubts.push_back(
            fmt::format("Points that are left out are not predicted (Q2 = {:.2f}, where 1 is perfect and 0 "
                        "is no better than "
                        "the mean): the inputs do not explain the efficiencies, or there are too few points.",
                        quality.q2));
    }
    if (!quality.coverage_is_right()) {
        doubts.push_back(
            fmt::format("{} of {} points lie within the 95 % intervals that the others predict, where {} to "
                        "{} are to be expected: "
                        "the intervals of the surface are {}.",
                        quality.covered, quality.points, quality.least_covered, quality.most_covered,
                        quality.covered < quality.least_covered ? "too narrow" : "too wide"));
    }
    if (quality.extra_noise > 0) {
        doubts.push_back(
            fmt::format("The points scatter by {:.2g} (standard deviation) more than their intervals say (p "
                        "= {:.1g}): the intervals "
                        "are too narrow, or the efficiency changes faster than the points can show.",
                        quality.extra_noise, quality.extra_noise_p));
    }
    return doubts;
}

}  // namespace vibrotrough::atlas
