#pragma once

#include "theory/drive.hpp"

#include <optional>
#include <span>

namespace vibrotrough::learn {

/// What a model misses within a region: a row of validation/model_errors/errors.csv.
struct ModelError {
    theory::Range throw_number;     ///< Gamma
    theory::Range tan_inclination;  ///< tan(alpha), uphill positive
    theory::Range depth;            ///< of the layer, in diameters of its grains
    int layers;                     ///< that were simulated there
    /// Standard deviation of a normal distribution that holds the error, in velocity efficiency, up to
    /// usual_confidence: the root mean square of so few layers times t(0.975; layers) / 1.96.
    double sd;
};

inline constexpr double usual_confidence = 0.975;  ///< one-sided: of the ends of a 95 % interval

/// The errors of the point mass, from simulated layers whose grains do not roll.
std::span<ModelError const> point_mass_errors();
/// The errors of the rolling-layer law, from layers of spheres that roll.
std::span<ModelError const> rolling_layer_errors();

/// What is known of the error of a model at a place, the row of the largest sd; nullptr where no layer says
/// it.
/// @param depth  of the layer, in diameters of its grains; nothing: any
ModelError const* known_row(std::span<ModelError const> errors, double throw_number, double tan_inclination,
                            std::optional<double> depth);

/// Standard deviation of what a model misses; nothing where no layer says it.
std::optional<double> known_error(std::span<ModelError const> errors, double throw_number,
                                  double tan_inclination, std::optional<double> depth);

/// The largest of them.
double largest_error(std::span<ModelError const> errors);

/// The largest throw number of which they say something.
double largest_throw_number(std::span<ModelError const> errors);

}  // namespace vibrotrough::learn
