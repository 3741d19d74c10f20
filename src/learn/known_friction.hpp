#pragma once

#include "theory/drive.hpp"

#include <vector>

namespace vibrotrough::learn {

/// A part of the distribution of a friction.
struct FrictionPart {
    double share;     ///< of the distribution
    double friction;  ///< in its middle
    /// Standard deviations, in velocity efficiency, of what the calibrated model misses: of each draw in this
    /// part; empty when the friction comes from no calibration.
    std::vector<double> discrepancies;
};

/// The friction of a material on the trough, and how sure it is: a normal distribution, or draws.
struct KnownFriction {
    double median;                   ///< of its distribution
    double low, high;                ///< ends of its central 99.7 %, within which a design keeps every limit
    double sd = 0;                   ///< of the normal distribution; 0 when the friction is exact or drawn
    std::vector<double> draws = {};  ///< equally likely, in rising order; empty: the distribution is normal
    std::vector<double> discrepancies = {};  ///< beside each draw, as in FrictionPart; may be empty

    /// The parts of the distribution between some of its shares; one part when the friction is exact.
    /// @param ends  shares from 0 to 1, both included, in rising order
    std::vector<FrictionPart> parts(std::vector<double> const& ends) const;
    /// The central part of the distribution. @param share  of it, in (0, 1)
    theory::Range central(double share) const;
};

/// A friction that is distributed normally, cut at 0.01. @param sd  its standard uncertainty, >= 0
/// @throws std::invalid_argument when the median is below 0.01 or sd is negative
KnownFriction normal_friction(double median, double sd);

/// A friction that may be anything between two ends. @throws std::invalid_argument when they are in the wrong
/// order, or the lower one is below 0.01
KnownFriction friction_between(double low, double high);

/// The posterior of a calibration. @param friction  at least 100 draws
/// @param discrepancy  the draws of the model discrepancy beside them, in velocity efficiency, or none
/// @throws std::invalid_argument when there are too few draws or a friction is below 1e-3
KnownFriction drawn_friction(std::vector<double> const& friction, std::vector<double> const& discrepancy);

/// Shares that cut a distribution into the few parts by which machines are searched for. A narrow part stands
/// where the tail outside of the confidence begins, on each side: there lies the sure speed of a model
/// without an error of its own. @param confidence  in [0.5, 1)
std::vector<double> few_parts(double confidence);

/// Shares that cut a distribution into the many parts by which a machine is judged: equal ones, and
/// twenty for the tail outside of the confidence and what is next to it, on each side.
/// @param confidence  in [0.5, 1)
/// @param equal_parts  400 know the probability of a model without an error of its own to half a point
std::vector<double> many_parts(double confidence, int equal_parts = 400);

}  // namespace vibrotrough::learn
