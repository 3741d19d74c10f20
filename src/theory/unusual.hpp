#pragma once

#include <optional>
#include <string>
#include <vector>

/// @file
/// Numbers that are possible but that hardly any vibrating trough has: most are slips of a unit.

namespace vibrotrough::theory {

inline constexpr double largest_usual_frequency = 120;     ///< Hz; magnets at twice the mains' 60 Hz
inline constexpr double smallest_usual_frequency = 1;      ///< Hz
inline constexpr double largest_usual_amplitude = 0.05;    ///< m
inline constexpr double largest_usual_machine_number = 9;  ///< K
inline constexpr double largest_usual_friction = 1.5;      ///< of the mass on the trough
inline constexpr double smallest_usual_angle = 0.028;  ///< rad, 1.6 degrees: 90 degrees written in radians

/// What is known of a motion; nothing where an input was not given.
struct MachineNumbers {
    std::optional<double> frequency;             ///< Hz
    std::optional<double> amplitude;             ///< m, half the stroke
    std::optional<double> machine_number;        ///< K = omega^2 r / g
    std::optional<double> friction;              ///< mu
    std::optional<double> vibration_angle = {};  ///< beta, rad
    bool is_stroke = false;                      ///< the amplitude was given as a stroke
    bool is_turns = false;                       ///< the frequency was given in turns per minute
};

/// A sentence for each number that is unusual: what is usual, and which slip would explain it.
std::vector<std::string> unusual_numbers(MachineNumbers const& numbers);

}  // namespace vibrotrough::theory
