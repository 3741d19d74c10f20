#pragma once

#include "inference/sampler.hpp"
#include "learn/speeds.hpp"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Dense>

namespace vibrotrough::learn {

/// A quantity that is to be found, and what is known of it before: any value between two bounds, each as
/// likely (a uniform prior).
struct FreeParameter {
    std::string name;         ///< e.g. "friction"
    std::string unit;         ///< e.g. "degree", "1" without one
    inference::Bounds prior;  ///< in that unit
};

/// What a model says about a measurement.
struct ModelSpeed {
    double speed;         ///< m/s
    double sd;            ///< m/s, standard deviation of the model's own uncertainty; 0 for an exact theory
    double trough_speed;  ///< m/s, omega r cos(beta): the speed of velocity efficiency 1
    /// m/s, standard deviation of the part of the uncertainty that is the same in all measurements, in units
    /// of each one's; it comes beside `sd`.
    double common_sd;
};

/// The model's answer for one value per free parameter, or nothing when the material has no steady speed
/// there.
using CalibrationModel =
    std::function<std::optional<ModelSpeed>(std::span<double const> values, MeasuredSpeed const&)>;

/// Whether measurements and model may differ by more than the uncertainties.
enum class Discrepancy {
    estimated,  ///< each measurement may be off by a normal error, whose size is estimated with the rest
    none,       ///< the model is taken to be exact
};

/// How a calibration is made.
struct CalibrationSettings {
    Discrepancy discrepancy = Discrepancy::estimated;  ///< of the model
    /// Standard deviation, in velocity efficiency, of an error of the model that has the same size and sign
    /// in all measurements, >= 0.
    double common_error = 0;
    /// Errors of the model that all measurements have in common, which its best fit does not know: a row for
    /// each measurement, and a column for each error, with its size there as one standard deviation, in
    /// velocity efficiency. Empty without any.
    Eigen::MatrixXd layer_errors = {};
    inference::SamplerSettings sampler = {};  ///< of the posterior
};

/// Smallest and largest standard deviation of the model discrepancy, in velocity efficiency.
inline constexpr inference::Bounds discrepancy_prior{0.001, 0.5};

/// What the data say about a quantity.
struct Estimate {
    FreeParameter parameter;    ///< which one
    double median;              ///< of the posterior
    double low, high;           ///< ends of its central 95 % interval
    double rhat, ess;           ///< convergence of the chains, see inference/diagnostics.hpp
    std::vector<double> draws;  ///< of the posterior, chain after chain
    /// The shortest set that holds 95 % of the posterior; more than one range when separate values fit.
    std::vector<inference::Bounds> ranges;
    double remaining;   ///< width of `ranges` over that of 95 % of the prior: 1 when the data say nothing
    bool identifiable;  ///< whether `remaining` is at most one half
};

/// A measurement beside the calibrated model.
struct Misfit {
    MeasuredSpeed measured;   ///< as it was given
    double median;            ///< m/s, of the model (without discrepancy) over the posterior
    double low, high;         ///< m/s, its central 95 % interval
    double in_uncertainties;  ///< (measured - median) / uncertainty of measurement and model
    double common_error;  ///< standard deviation, in velocity efficiency, by the settings of the calibration
};

/// How well the model can fit at best when it is taken to be exact.
struct BestFit {
    std::vector<double> values;  ///< of the free parameters
    double chi_square;           ///< sum of the squared misfits in uncertainties
    int degrees_of_freedom;      ///< measurements minus free parameters; 0 or less: nothing can be judged
    double p_value;  ///< probability of so large a chi_square by chance; 1 when it cannot be judged
};

/// The result of a calibration.
struct Calibration {
    std::vector<Estimate> parameters;     ///< in the order in which they were given
    std::optional<Estimate> discrepancy;  ///< standard deviation, in velocity efficiency
    std::vector<Misfit> misfits;          ///< in the order of the measurements
    BestFit best;                         ///< of the model without discrepancy
    bool converged;                       ///< whether the chains did
    bool holds_layer_errors = false;      ///< whether CalibrationSettings::layer_errors were given
};

/// Finds the free parameters of a model from measured speeds.
///
/// Likelihood of the measurements: normal, around the model's speeds, with the covariance
///     diag(uncertainty^2 + sd^2 + (delta omega r cos(beta))^2) + sum_k c_k c_k^T
/// of measurement, model (the surface of a learnt layer) and model discrepancy, and of what the model misses
/// in all measurements alike: the c_k are common_sd and, times omega r cos(beta), common_error and each
/// column of layer_errors. delta, in velocity efficiency, is the same for all measurements and is estimated;
/// its prior is uniform in log(delta) between the ends of `discrepancy_prior`, which prefers no size, so that
/// data which the model explains make it vanish. (After M.C. Kennedy and A. O'Hagan, J. R. Stat. Soc. B 63
/// (2001) 425-464, with errors that are independent from setting to setting.) Where the model has no steady
/// speed, the likelihood is zero.
///
/// @throws core::InputError when the model has no steady speed for any value within the prior
Calibration calibrate(CalibrationModel const& model, std::vector<FreeParameter> const& parameters,
                      std::vector<MeasuredSpeed> const& speeds, CalibrationSettings const& settings = {});

/// The values of the free parameters, within their priors, at which the model without discrepancy fits best:
/// the least chi-square of a search by NLopt (SBPLX) from the best of a few hundred points spread over the
/// prior.
/// @param common_error  as CalibrationSettings
/// @throws core::InputError as calibrate
BestFit best_fit(CalibrationModel const& model, std::vector<FreeParameter> const& parameters,
                 std::vector<MeasuredSpeed> const& speeds, double common_error = 0);

/// The shortest set of ranges that holds 95 % of the draws, from a histogram of 50 bins. Gaps of fewer than
/// three bins are closed.
std::vector<inference::Bounds> highest_density_ranges(std::vector<double> const& draws);

}  // namespace vibrotrough::learn
