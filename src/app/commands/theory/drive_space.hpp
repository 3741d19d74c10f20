#pragma once

#include "app/commands/theory/options.hpp"
#include "theory/drive.hpp"

#include <optional>
#include <vector>

namespace vibrotrough::app {

/// The options of `design` that say among which drives it chooses.
struct DriveTexts {
    Text rpm, frequency, stroke, amplitude;  ///< of each pair one
    Text poles, mains, slip;                 ///< of the motors that turn the shaft, instead of its speed
    Text vibration_angle, inclination;       ///< ranges
    Text machine_number, throw_number;       ///< largest values
};

/// A space of drives, and the strokes and speeds of which it is made where they were listed.
struct ReadSpace {
    theory::DriveSpace space;         ///< from the smallest to the largest value of each
    std::vector<double> frequencies;  ///< Hz
    std::vector<double> amplitudes;   ///< m
};

/// @throws core::InputError when an option is wrong, given in two forms, or outside of what can be solved
ReadSpace read_drive_space(DriveTexts const& texts);

/// @throws core::InputError when even the flattest trough of the space is so steep that the material runs
/// away
void check_slope(DriveTexts const& texts, theory::DriveSpace const& space, double friction,
                 std::string const& why_so_low = "");

/// Says on standard error which numbers of a task are unusual, and which slip would explain it.
void tell_unusual(DriveTexts const& texts, theory::DriveSpace const& space, double friction,
                  std::optional<double> bulk_density);

}  // namespace vibrotrough::app
