#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace vibrotrough::deck {

/// The error of a numerical setting that validation/convergence found in its layer (spheres of 3 mm, four
/// diameters high, throw number 2).
struct KnownError {
    double measure;       ///< of the setting, without dimension: the smaller, the nearer to the limit
    double error;         ///< of the velocity efficiency: this setting minus the limit
    double half_width;    ///< of its 95 % interval
    std::string_view at;  ///< the setting in words
};

/// Short boxes, by diameters over length.
std::span<KnownError const> known_length_errors();
/// Narrow boxes, by diameters over width.
std::span<KnownError const> known_width_errors();

/// The largest error that is known of settings which are as near to the limit as this one, or nearer. Errors
/// within their intervals do not count. None when no such setting has shown an error.
/// @param measure  of the setting, as in KnownError
std::optional<KnownError> largest_known_error(std::span<KnownError const> errors, double measure);

}  // namespace vibrotrough::deck
