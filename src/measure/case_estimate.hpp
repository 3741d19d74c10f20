#pragma once

#include "measure/estimate.hpp"

#include <optional>
#include <span>
#include <vector>

namespace vibrotrough::measure {

/// How a packing was started: with a mean speed below or above the one that was expected.
enum class Start {
    below,
    above,
};

/// The cycle values of one packing and how it was started.
struct PackingValues {
    std::span<double const> values;  ///< one per cycle
    Start start;                     ///< group of the packing
};

/// Whether the packings of a case agree that it is steady.
enum class Steadiness {
    steady,
    drifting,   ///< the start-up is not over, or the values still drift in the same direction
    branching,  ///< packings that started below differ from those that started above
};

/// The packings of a case that were started in one way.
struct Branch {
    double mean;                       ///< of the cycles kept
    std::optional<double> half_width;  ///< of its confidence interval; none with fewer than two packings
    int packings;                      ///< in this group
};

/// The mean over the packings of a case.
struct CaseEstimate {
    std::optional<double> mean;  ///< none when there are no cycles, or the case is not steady
    /// Of its confidence interval, with what is left of a start-up; none when the interval is unbounded.
    std::optional<double> half_width;
    int packings = 0;             ///< number of packings
    int discarded = 0;            ///< cycles of every packing that are left out as start-up
    int measured = 0;             ///< cycles of every packing that are kept
    double correlation_time = 1;  ///< statistical inefficiency g of the cycles, pooled over the packings
    std::optional<double> deviation{};  ///< standard deviation of the mean of one packing; none if unbounded
    /// The part of `deviation` that the fluctuations within a run explain.
    double deviation_within = 0;
    Steadiness steadiness = Steadiness::steady;  ///< whether the mean may be used
    /// The part of `half_width` for what is probably left of a common start-up, see drift_left(). It adds to
    /// the statistical part as the root of the sum of squares.
    double drift = 0;
    std::optional<Branch> below{};  ///< packings that started below the expected speed, if there are any
    std::optional<Branch> above{};  ///< packings that started above it, if there are any
};

/// The start-up that the packings of a case have in common: the longer one of MSER with the sum of squares
/// over all packings and MSER of their mean, which shows drifts that the fluctuations of single packings hide
/// (Hoad, Robinson & Davies, Journal of the Operational Research Society 61, 2010, 1632-1644). One length for
/// all packings wastes fewer cycles than one for each, because slow fluctuations in a single run look like a
/// start-up.
/// @return a number of cycles, at most half of them
int common_startup_length(Runs runs);

/// The mean over packings with an interval that allows for both of its sources: the fluctuations within a run
/// and the differences between packings.
///
/// Packings are independent, so that the scatter S of their P means contains both sources, with P - 1 degrees
/// of freedom (replication/deletion; Law, Simulation Modeling and Analysis, section 9.5.2). For few packings
/// S can be small by chance. It cannot be smaller than the deviation w that the fluctuations within the runs
/// imply: w^2 = s^2 g / m, with the variance s^2 and the statistical inefficiency g of the m cycles kept,
/// pooled over the packings (fluctuations_of()). So when S < w, the interval rests on the pooled variance of
/// S and w, but not less than w, and their common degrees of freedom.
///
/// The statistical half-width is that of Student's t at the level 1 - 0.5 (1 - confidence): packings are
/// added until the interval is narrow enough, which favours intervals that are too narrow by chance (Chow &
/// Robbins, Annals of Mathematical Statistics 36, 1965, 457-462), and the offsets of packings may be skewed.
/// What is left of a common start-up is added to it, see drift_left().
/// tests/campaign/fabricated_packings_test.cpp and reference_test.cpp measure what this achieves.
///
/// The case is not steady if the common start-up takes half of the cycles and the ensemble mean still changes
/// by more than the half-width wanted; if the second half of the cycles kept differs from the first by more
/// than that, and significantly over the packings (paired t, 99 %); or if the two groups of starts differ by
/// more than that, and significantly (two-sample t, 99 %). The idea of starting from both sides is that of
/// Gelman & Rubin, Statistical Science 7, 1992, 457-472.
///
/// A single packing is judged like estimate_packing().
/// @param packings  at least one, equally long
/// @param startup   cycles that are a start-up by what is known otherwise; more are left out if the values
/// ask for it
/// @throws std::invalid_argument when there are none, or their lengths differ
CaseEstimate estimate_case(std::span<PackingValues const> packings, Precision const& wanted, int startup = 0);

/// Whether the interval of a case is as narrow as wanted.
bool is_precise(CaseEstimate const& estimate, Precision const& wanted);

/// The number of packings after which the interval will probably be as narrow as wanted.
/// @return none while the deviation of a packing is unknown; at most 1e6
std::optional<int> packings_needed(CaseEstimate const& estimate, Precision const& wanted);

}  // namespace vibrotrough::measure
