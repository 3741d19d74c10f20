#pragma once

#include "theory/drive.hpp"

#include <array>
#include <functional>
#include <optional>

namespace vibrotrough::learn {

/// What is known of a number that is not known exactly.
enum class Shape {
    normal,   ///< a normal distribution
    uniform,  ///< anything between two ends, mean - sqrt(3) sd and mean + sqrt(3) sd
};

/// A number that is not known exactly.
struct Uncertain {
    double mean;                  ///< of its distribution
    double sd = 0;                ///< its standard uncertainty, >= 0
    Shape shape = Shape::normal;  ///< of its distribution

    double low() const;   ///< end of a uniform distribution
    double high() const;  ///< the other end
};

/// Anything between two ends. @throws std::invalid_argument when low > high
Uncertain between_ends(double low, double high);

/// What the rolling friction of grains is where nobody knows it: anything up to 0.2, as far as layers were
/// simulated (validation/atlas).
Uncertain unknown_rolling_friction();

/// A value of a distribution and its share.
struct UncertainNode {
    double share;  ///< of the distribution
    double value;  ///< in its middle
};

/// Three values that stand for a distribution: the nodes of Gauss' quadrature, exact for means of polynomials
/// up to the fifth degree (M. Abramowitz and I.A. Stegun, Handbook of Mathematical Functions, 25.4.29 and
/// 25.4.46).
std::array<UncertainNode, 3> nodes_of(Uncertain const& number);

/// Standard deviation of what follows from a number that is not known exactly, by these nodes. Those from
/// which nothing follows are left out; 0 where nothing does.
double deviation_of(Uncertain const& number, std::function<std::optional<double>(double)> const& value_at);

/// The same where what follows is known within a range only: beyond it, it goes on with the slope from the
/// mean to the end of the range.
double deviation_within(theory::Range const& known, Uncertain const& number,
                        std::function<std::optional<double>(double)> const& value_at);

}  // namespace vibrotrough::learn
