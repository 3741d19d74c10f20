#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Dense>

namespace vibrotrough::inference {

/// Values that were measured at some inputs. Inputs should be scaled to comparable ranges, such as [0, 1].
struct ProcessData {
    Eigen::MatrixXd inputs;  ///< one row per value, one column per input
    Eigen::MatrixXd trend;   ///< one row per value, one column per function of the trend, e.g. {1, theory}
    Eigen::VectorXd values;  ///< measured
    Eigen::VectorXd noise;   ///< standard deviation of each value about the truth, >= 0
};

/// What is known of the trend's coefficients before: independent normal distributions.
struct TrendPrior {
    Eigen::VectorXd mean;  ///< of each coefficient
    Eigen::VectorXd sd;    ///< its standard deviation, > 0; large when little is known
};

/// The free quantities of the process itself.
struct Hyperparameters {
    double deviation;         ///< standard deviation of the values about the trend, > 0
    Eigen::VectorXd lengths;  ///< over which the values vary, one per input, > 0
    double extra_noise = 0;   ///< standard deviation of noise that `noise` does not contain, >= 0
};

/// What is known of a positive number before: its logarithm is distributed normally.
struct LogNormal {
    double median;  ///< > 0
    double log_sd;  ///< standard deviation of the logarithm, > 0
};

/// What is known of hyperparameters before. Of those that are not named every logarithm is equally likely.
struct HyperparameterPrior {
    std::optional<LogNormal> deviation = {};             ///< of the process
    std::vector<std::optional<LogNormal>> lengths = {};  ///< one per input, or empty

    /// Logarithm of its density over the logarithms, but for a constant.
    double log_density(Hyperparameters const& hyperparameters) const;
    /// Derivatives of log_density() by the logarithms, in the order of
    /// GaussianProcess::log_likelihood_gradient().
    Eigen::VectorXd gradient(Hyperparameters const& hyperparameters) const;
    /// @throws std::invalid_argument when medians or deviations are not above 0, or lengths do not fit the
    /// inputs
    void check(Eigen::Index inputs) const;
};

/// How hyperparameters are found.
struct ProcessSettings {
    Hyperparameters least{1e-3, {}, 1e-4};  ///< lower bounds; empty lengths: 0.05 each
    Hyperparameters most{3, {}, 1};         ///< upper bounds; empty lengths: 20 each
    bool has_extra_noise = false;           ///< whether extra noise is estimated as well
    HyperparameterPrior prior;              ///< its density counts beside the likelihood
    int starts = 10;                        ///< points from which the likelihood is climbed
    std::uint64_t seed = 1;                 ///< of these points
};

/// A value of the process at some inputs: normally distributed.
struct ProcessValue {
    double mean;  ///< best estimate
    double sd;    ///< standard deviation of the truth about it
};

/// A mixture of normal distributions that are equally likely. @return its mean and standard deviation
ProcessValue mixture(std::vector<ProcessValue> const& parts);

/// A Gaussian process: normal distributions of a function's values at all inputs, conditioned on data.
///
///     f(x) = h(x) beta + z(x),   beta_k ~ N(mean_k, sd_k^2),
///     cov z(x), z(x') = deviation^2 (1 + a) exp(-a),   a^2 = 3 sum_j ((x_j - x'_j) / length_j)^2,
///
/// the Matern covariance of smoothness 3/2 with one length per input: functions whose slope is continuous and
/// may change within a short range. With a smoothness of 5/2, learnt surfaces of 16 to 26 points held only 48
/// to 55 of 60 further simulations, instead of 54 to 56. (C.E. Rasmussen and C.K.I. Williams, Gaussian
/// Processes for Machine Learning, 2006, Eqs. 2.23-2.24, 2.30, 4.17, 5.8-5.12; the trend is part of the
/// covariance, section 2.7.)
class GaussianProcess {
  public:
    /// Conditions a process on data. @throws std::invalid_argument when sizes do not fit, a number is out of
    /// range, or the data contradict each other (two values without noise at one place)
    GaussianProcess(ProcessData data, TrendPrior prior, Hyperparameters hyperparameters);

    /// Conditions a process whose hyperparameters have the largest likelihood, times the density of what is
    /// known of them: NLopt's LBFGS with exact derivatives climbs from several points, in the logarithms of
    /// the hyperparameters.
    /// @throws std::invalid_argument as the constructor, and when bounds have no sense
    static GaussianProcess fitted(ProcessData data, TrendPrior prior, ProcessSettings const& settings);

    /// The function at some inputs, without the noise of a measurement.
    /// @param trend  the functions of the trend there
    ProcessValue predict(Eigen::VectorXd const& inputs, Eigen::VectorXd const& trend) const;

    /// The mean alone of predict(), which takes a fraction of the time.
    double mean(Eigen::VectorXd const& inputs, Eigen::VectorXd const& trend) const;

    /// Covariance of the function at two places, given the data.
    double covariance(Eigen::VectorXd const& inputs_a, Eigen::VectorXd const& trend_a,
                      Eigen::VectorXd const& inputs_b, Eigen::VectorXd const& trend_b) const;

    /// What the process would have said of each value (with its noise) without that value, at the same
    /// hyperparameters.
    std::vector<ProcessValue> leave_one_out() const;

    double log_likelihood() const { return log_likelihood_; }                    ///< of the data
    Hyperparameters const& hyperparameters() const { return hyperparameters_; }  ///< of the process
    ProcessData const& data() const { return data_; }  ///< on which it is conditioned

    /// Derivatives of log_likelihood() by the logarithms of deviation, lengths and extra noise, in this
    /// order.
    Eigen::VectorXd log_likelihood_gradient() const;

  private:
    static void check(ProcessData const& data, TrendPrior const& prior);
    double prior_covariance(Eigen::VectorXd const& inputs_a, Eigen::VectorXd const& trend_a,
                            Eigen::VectorXd const& inputs_b, Eigen::VectorXd const& trend_b) const;
    Eigen::VectorXd covariances_with_data(Eigen::VectorXd const& inputs, Eigen::VectorXd const& trend) const;

    ProcessData data_;
    TrendPrior prior_;
    Hyperparameters hyperparameters_;
    Eigen::LLT<Eigen::MatrixXd> factor_;  ///< of the covariance of the data with noise
    Eigen::VectorXd weights_;             ///< its inverse times (values - mean of the trend)
    double log_likelihood_ = 0;
};

}  // namespace vibrotrough::inference
