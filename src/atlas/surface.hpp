#pragma once

#include "inference/gaussian_process.hpp"

#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::atlas {

/// An input of a surface and the range that is scaled to [0, 1].
struct SurfaceInput {
    std::string key;   ///< path of the key in the campaign file
    double low, high;  ///< ends of the range, SI units, low < high
    /// Equal ratios of the input, not equal differences, are equally far; low > 0 then.
    bool is_logarithmic = false;

    /// The share of the range below a value: 0 at its low end, 1 at its high one, and so on beyond them.
    /// @param value  > 0 where the input is logarithmic
    double share_of(double value) const;
    /// The value at a share of the range.
    double value_at(double share) const;
};

/// A place: one value per input of the surface, SI units.
using Place = std::vector<double>;

/// A simulated case as a point of the surface.
struct SurfacePoint {
    std::string case_id;  ///< of the case
    Place place;          ///< its inputs
    double theory;        ///< velocity efficiency of the theory, or of another model, there
    double efficiency;    ///< velocity efficiency of the layer
    double half_width;    ///< of its 95 % confidence interval, >= 0
};

/// Whether the theory's velocity efficiency is part of the trend.
enum class Trend {
    theory,    ///< constant and theory (or another model): only the difference is learnt
    constant,  ///< constant alone, for comparison
};

/// The longest length over which a surface varies, in widths of an input's range, unless it is told another.
inline constexpr double usual_longest_length = 5;

/// What is taken of a surface before its points are known.
struct SurfacePrior {
    Trend trend = Trend::theory;  ///< of the process
    /// The least standard deviation of the values about the trend, in velocity efficiency. A trend that errs
    /// by more than few points can show needs one.
    double least_deviation = 0.005;
    /// The longest length over which a surface varies, in widths of each input's range; empty:
    /// usual_longest_length for each.
    std::vector<double> longest = {};
    /// What is known of the values about the trend, in velocity efficiency and widths of the ranges.
    inference::HyperparameterPrior about_trend = {};
    double offset_sd = 1;  ///< standard deviation of beta_0 about 0 (Surface)
    double slope_sd = 1;   ///< standard deviation of beta_1 about 1
};

/// Standard deviations of a normal distribution in the half-width of its central 95 %.
inline constexpr double deviations_in_half_width = 1.959963984540054;

/// What the surface says of a place.
struct SurfaceValue {
    double efficiency;  ///< velocity efficiency of the layer
    double half_width;  ///< of its 95 % interval
};

/// How well a surface predicts its own points, each from all others.
struct SurfaceQuality {
    int points;   ///< number of points
    double q2;    ///< 1 - sum of squared errors over that of the mean; 1 at best, <= 0 useless
    int covered;  ///< points within their predicted 95 % interval
    int least_covered, most_covered;  ///< central 95 % band of the binomial distribution of `covered`
    /// Standard deviation of scatter that the points' intervals do not contain; 0 unless it is significant.
    double extra_noise;
    double extra_noise_p;  ///< probability of such a sign of extra noise by chance

    /// Whether `covered` lies in its band.
    bool coverage_is_right() const { return covered >= least_covered && covered <= most_covered; }
};

/// The velocity efficiency of a layer over the inputs of a campaign, and how sure it is: a Gaussian process
/// (inference/gaussian_process.hpp) with the trend beta_0 + beta_1 theory, beta_0 ~ N(0, offset_sd^2), beta_1
/// ~ N(1, slope_sd^2), and the noise of every point from its own interval.
///
/// Few points do not tell the hyperparameters well, and those of the largest likelihood give intervals that
/// are too narrow. What the surface says of a place is therefore the mean and the variance over 24 draws from
/// the posterior of the hyperparameters (equally likely in their logarithm within wide bounds, unless more is
/// known). The process of the largest likelihood, with what is known, decides about extra noise and what to
/// simulate next.
///
/// If the points scatter by more than their intervals say (likelihood ratio test, p < 0.01), extra noise is
/// estimated and kept, so that the surface does not pretend to be sure.
class Surface {
  public:
    /// Fits a surface.
    /// @throws core::InputError when there are too few points: fewer than four, or than twice the number of
    ///   inputs
    Surface(std::vector<SurfaceInput> inputs, std::vector<SurfacePoint> points,
            SurfacePrior const& prior = {});

    /// A surface whose hyperparameters were drawn from their posterior before, as draws() of another over the
    /// same points gave them: nothing is searched for, and the first draw stands for the process of the
    /// largest likelihood.
    /// @throws std::invalid_argument when there are no draws, or they do not fit the inputs
    Surface(std::vector<SurfaceInput> inputs, std::vector<SurfacePoint> points,
            std::vector<inference::Hyperparameters> const& draws);

    /// The velocity efficiency at a place. @param theory  velocity efficiency of the theory there
    SurfaceValue at(Place const& place, double theory) const;

    /// The efficiency alone of at(), which takes a fraction of the time.
    double efficiency_at(Place const& place, double theory) const;

    /// at() by the process of the largest likelihood alone, which takes a twentieth of the time.
    SurfaceValue nearly_at(Place const& place, double theory) const;

    /// The efficiency alone of nearly_at().
    double near_efficiency_at(Place const& place, double theory) const;

    /// What the surface says of the efficiency at one place minus that at another, of which it knows more
    /// than of either: what both have in common does not widen the interval.
    SurfaceValue difference(Place const& place, double theory, Place const& other, double theory_there) const;

    /// By how much a further value at `where`, with so wide a 95 % interval, would lower the variance of the
    /// efficiency at `place`, by the process of the largest likelihood.
    double variance_reduction(Place const& place, double theory, Place const& where, double theory_there,
                              double half_width) const;

    /// Takes a point as known, without finding the hyperparameters of the surface again.
    void believe(SurfacePoint const& point);

    /// How well the surface predicts its own points, which takes as long as a few hundred predictions.
    SurfaceQuality quality() const;
    /// Why the surface should not be used, in whole sentences; empty when nothing speaks against it.
    std::vector<std::string> doubts() const;

    std::vector<SurfaceInput> const& inputs() const { return inputs_; }     ///< of the surface
    std::vector<SurfacePoint> const& points() const { return points_; }     ///< on which it rests
    SurfacePrior const& prior() const { return prior_; }                    ///< with which it was fitted
    inference::GaussianProcess const& process() const { return process_; }  ///< of the largest likelihood
    /// The draws from the posterior of the hyperparameters, over which the surface averages.
    std::vector<inference::Hyperparameters> draws() const;
    /// The place scaled to [0, 1] where the ranges lie.
    Eigen::VectorXd scaled(Place const& place) const;

  private:
    inference::ProcessData data() const;
    inference::GaussianProcess fit();
    void draw_others();
    Eigen::VectorXd trend_at(double theory) const;
    inference::TrendPrior trend_prior() const;

    std::vector<SurfaceInput> inputs_;
    std::vector<SurfacePoint> points_;
    SurfacePrior prior_;
    double extra_noise_p_ = 0;  ///< probability of such a sign of extra noise by chance
    inference::GaussianProcess process_;
    std::vector<inference::GaussianProcess> others_;  ///< with hyperparameters drawn from their posterior
};

/// Half-width of what the points scatter about the surface beyond their own intervals: 95 %.
double scatter_half_width(Surface const& surface);

}  // namespace vibrotrough::atlas
