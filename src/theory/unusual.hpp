#pragma once

#include <optional>
#include <string>
#include <vector>

/// @file
/// Numbers that are possible but that hardly any vibrating trough has: most are slips of a unit.

namespace vibrotrough::theory {

inline constexpr double smallest_usual_frequency = 1;      ///< Hz
inline constexpr double largest_usual_machine_number = 9;  ///< K

/// What is known of a motion; nothing where an input was not given.
struct MachineNumbers {
    std::optional<double> frequency;             ///< Hz
    std::optional<double> amplitude;             ///< m, half the stroke
    std::optional<double> machine_number;        ///< K = omega^2 r / g
    std::optional<double> friction;              ///< mu
    std::optional<double> vibration_angle = {};  ///< beta, rad
    bool is_stroke = false;                      ///< the amplitude was given as a stroke
    bool is_turns = false;                       ///< the frequency was given in turns per minute
    std::optional<double> bulk_density = {};     ///< kg/m3, of the layer
    std::optional<double> grain_density = {};    ///< kg/m3, of the grains' material
};

/// What is unusual.
enum class UnusualQuantity {
    frequency,
    amplitude,
    machine_number,
    vibration_angle,
    friction,
    bulk_density,
    grain_density
};

/// A number that is unusual, in the quantity and the unit in which it was given.
struct UnusualNumber {
    UnusualQuantity quantity;  ///< what is unusual
    std::string name;          ///< of what was given: "frequency", "speed of the drive", "stroke"
    double value;              ///< in `unit`
    double limit;              ///< the largest or the smallest value that is usual, in `unit`
    std::string unit;          ///< "1" for a plain number
    std::string usual;         ///< what is usual: "vibrating troughs run at 1 to 120 Hz"
    std::string slip = {};     ///< which slip would explain it, as a question; empty where none does

    /// The value is below the limit, not above it.
    bool is_too_small() const { return value < limit; }
    /// All of it in one sentence, without a full stop.
    std::string sentence() const;
};

/// All numbers that are unusual, in the order of UnusualQuantity. Of frequency, amplitude and machine number
/// only the first one is named, because it explains those after it.
std::vector<UnusualNumber> find_unusual(MachineNumbers const& numbers);

/// The sentences of find_unusual().
std::vector<std::string> unusual_numbers(MachineNumbers const& numbers);

/// The slips that lead from a usual friction coefficient to this one, as a question; empty where none does.
std::string slip_of_friction(double friction);

/// The slip that leads from an angle within 90 degrees to this tangent, as a question; empty where none does.
std::string slip_of_tangent(double tangent);

}  // namespace vibrotrough::theory
