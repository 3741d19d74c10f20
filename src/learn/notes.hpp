#pragma once

#include "core/note.hpp"
#include "learn/known_friction.hpp"

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vibrotrough::learn {

// The notes of this module, from their text alone. The parse functions throw core::note::Fault when the text
// is not such a note.

/// learn.json. @returns the half-width that was wanted of each case, by its id, > 0
std::map<std::string, double> parse_half_widths(std::string_view text);

/// What a calibration says of the friction of the material on the trough.
struct CalibratedFriction {
    std::string model;          ///< that was calibrated
    double median, low, high;   ///< the central 95 % interval; 0 where there are draws
    std::vector<double> draws;  ///< of the posterior; empty when only the interval is known
    /// One for each draw, with what the model misses in common, as if that were independent of the friction,
    /// which is too careful for a machine like the measured one; may be empty.
    std::vector<double> discrepancies = {};
    bool converged = true;  ///< whether the chains of the calibration did; files of version 0.1 do not say it
};

/// The file of `theory calibrate --posterior`, or what it prints with --json.
CalibratedFriction parse_calibration(std::string_view text);

/// The friction of such a file, and the model that was calibrated, such as "the point mass". A median with
/// its interval counts as those of a normal distribution.
/// @param file  its name, for errors
/// @throws core::InputError when it is no calibration, has no friction, or did not converge
std::pair<KnownFriction, std::string> read_posterior(std::string_view text, std::string const& file);

}  // namespace vibrotrough::learn
