#include "core/error.hpp"
#include "learn/calibration.hpp"
#include "learn/joint_misfit.hpp"
#include "scenario/reader/sample_cube.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <boost/math/distributions/chi_squared.hpp>
#include <nlopt.hpp>

namespace vibrotrough::learn {
namespace {

constexpr double impossible = 1e300;
constexpr int starts = 5;

/// The model's chi-square over the unit cube of the priors, as NLopt asks for it.
class ChiSquare {
  public:
    ChiSquare(CalibrationModel const& model, std::vector<FreeParameter> const& parameters,
              std::vector<MeasuredSpeed> const& speeds, double common_error)
        : model_(model),
          parameters_(parameters),
          speeds_(speeds),
          common_errors_(same_error(speeds.size(), common_error)) {}

    std::vector<double> values(std::vector<double> const& cube) const {
        std::vector<double> result;
        for (std::size_t p = 0; p < cube.size(); ++p) {
            auto const [low, high] = parameters_[p].prior;
            result.push_back(low + (high - low) * cube[p]);
        }
        return result;
    }

    double operator()(std::vector<double> const& cube) const {
        auto const misfit = joint_misfit(model_, values(cube), speeds_, 0, common_errors_);
        return misfit ? std::min(misfit->chi_square, impossible) : impossible;
    }

    static double for_nlopt(std::vector<double> const& cube, std::vector<double>&, void* self) {
        return (*static_cast<ChiSquare const*>(self))(cube);
    }

  private:
    CalibrationModel const& model_;
    std::vector<FreeParameter> const& parameters_;
    std::vector<MeasuredSpeed> const& speeds_;
    Eigen::MatrixXd common_errors_;
};

}  // namespace

BestFit best_fit(CalibrationModel const& model, std::vector<FreeParameter> const& parameters,
                 std::vector<MeasuredSpeed> const& speeds, double common_error) {
    ChiSquare chi_square(model, parameters, speeds, common_error);
    std::vector<std::pair<double, std::vector<double>>> points;
    for (auto& point :
         scenario::sample_cube(scenario::SampleMethod::sobol, 400, static_cast<int>(parameters.size()), 1)) {
        double const value = chi_square(point);
        if (value < impossible) points.emplace_back(value, std::move(point));
    }
    if (points.empty()) {
        throw core::InputError(
            "the model has no steady speed for any value of the free parameters; widen their ranges with "
            "--prior");
    }
    std::ranges::sort(points);
    BestFit best{{}, impossible, 0, 1};
    for (std::size_t i = 0; i < std::min<std::size_t>(starts, points.size()); ++i) {
        nlopt::opt search(nlopt::LN_SBPLX, static_cast<unsigned>(parameters.size()));
        search.set_lower_bounds(0);
        search.set_upper_bounds(1);
        search.set_initial_step(0.05);
        search.set_xtol_abs(1e-7);
        search.set_maxeval(2000);
        search.set_min_objective(ChiSquare::for_nlopt, &chi_square);
        double value = impossible;
        std::vector<double> at = points[i].second;
        try {
            search.optimize(at, value);
        } catch (nlopt::roundoff_limited const&) {
            value = chi_square(at);  // the last point is as good as numbers allow
        }
        if (value < best.chi_square) {
            best.chi_square = value;
            best.values = chi_square.values(at);
        }
    }
    best.degrees_of_freedom = static_cast<int>(speeds.size()) - static_cast<int>(parameters.size());
    if (best.degrees_of_freedom > 0) {
        boost::math::chi_squared const distribution(best.degrees_of_freedom);
        best.p_value = boost::math::cdf(boost::math::complement(distribution, best.chi_square));
    }
    return best;
}

}  // namespace vibrotrough::learn
