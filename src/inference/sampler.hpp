#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace vibrotrough::inference {

/// The range of one parameter, outside which its density is zero. Ends are finite and low < high.
struct Bounds {
    double low, high;  ///< in the unit of the parameter
};

/// Natural logarithm of a probability density up to a constant, at one value per parameter within the bounds.
/// Minus infinity where the density is zero. NaN counts as minus infinity.
using LogDensity = std::function<double(std::span<double const> point)>;

/// How long and how often sample() draws.
struct SamplerSettings {
    int chains = 8;          ///< independent starts, >= 2; R-hat compares them
    int warm_up = 1000;      ///< steps of each chain that are thrown away while proposals are learnt, >= 100
    int draws = 1000;        ///< steps of each chain that are kept before convergence is judged first, >= 8
    int most_draws = 16000;  ///< steps of each chain after which sampling ends, converged or not
    double largest_rhat = 1.01;  ///< above it the chains go on (Vehtari et al. 2021)
    double least_ess = 400;      ///< below it the chains go on (Vehtari et al. 2021)
    std::uint64_t seed = 1;      ///< of the random numbers; the same seed gives the same draws
    int points_per_start =
        2000;  ///< random points within the bounds among which each chain chooses its start
    /// Points about the highest density, one for each chain or more, where they are known: chains begin at
    /// the first of them, and all of them stay in the archive. With many parameters no random point is near
    /// enough. They should be ten for each parameter, and scatter by a third of what the density does or so.
    std::vector<std::vector<double>> starts{};
    /// Called after each step of all chains and each point that is tried for a start, with the steps so far
    /// and the most that there can be.
    std::function<void(int steps, int most)> progress{};
};

/// Draws from a density, and how far they can be trusted.
struct Sample {
    int chains;                  ///< number of chains
    int draws;                   ///< of each chain
    int parameters;              ///< values of each draw
    std::vector<double> values;  ///< values[(chain * draws + draw) * parameters + parameter]
    std::vector<double> rhat;    ///< of each parameter, see rank_normalised_rhat()
    std::vector<double> ess;     ///< effective sample size of each parameter, the smaller of bulk and tails
    bool converged;              ///< whether every parameter has the R-hat and the sample size asked for

    /// One draw, parameter by parameter.
    std::span<double const> draw(int chain, int number) const;
    /// The draws of one parameter, chain after chain; chains * draws of them.
    std::vector<double> of(int parameter) const;
};

/// Draws from a density of a few parameters (one to about six, more with `starts`) by Markov chains, which
/// may have several separate peaks.
///
/// Method: differential evolution with an archive of past states (C.J.F. ter Braak and J.A. Vrugt, Statistics
/// and Computing 18 (2008) 435-446). A chain proposes x + gamma (z1 - z2) + noise with two states z1, z2 of
/// the archive and gamma = 2.38 / sqrt(2 d); every tenth proposal has gamma = 1, which jumps between peaks,
/// and every tenth is drawn uniformly within the bounds, which finds peaks that no chain has seen. The
/// archive is filled while the chains warm up and then kept as it is, so that the kept draws form Markov
/// chains whose stationary distribution is the density (Metropolis).
///
/// Without `starts`, each chain starts at one of `points_per_start` uniform points, chosen with a probability
/// proportional to the density there. Drawing goes on, each time as long again, until convergence or
/// `most_draws`.
///
/// @throws std::invalid_argument when bounds or settings have no sense, and when the density is zero at every
/// point that was tried
Sample sample(LogDensity const& density, std::vector<Bounds> const& bounds, SamplerSettings const& settings);

}  // namespace vibrotrough::inference
