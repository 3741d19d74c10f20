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
    double sd;                      ///< standard deviation of the error, in velocity efficiency
};

/// The errors of the point mass, from simulated layers whose grains do not roll.
std::span<ModelError const> point_mass_errors();
/// The errors of the rolling-layer law, from layers of spheres that roll.
std::span<ModelError const> rolling_layer_errors();

/// Standard deviation of what a model misses; nothing where no layer says it.
/// @param depth  of the layer, in diameters of its grains; when it is not known, the largest of all depths
std::optional<double> known_error(std::span<ModelError const> errors, double throw_number,
                                  double tan_inclination, std::optional<double> depth);

/// The largest of them.
double largest_error(std::span<ModelError const> errors);

/// The largest throw number of which they say something.
double largest_throw_number(std::span<ModelError const> errors);

/// The largest depth, in diameters of a grain.
double largest_depth(std::span<ModelError const> errors);

}  // namespace vibrotrough::learn
