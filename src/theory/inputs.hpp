#pragma once

#include "theory/conveyor.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::theory {

/// The inputs that describe a motion, one number each. They are the axes of maps and the columns of batches.
enum class Input : std::size_t {
    throw_number,
    machine_number,
    vibration_angle_deg,
    tan_vibration_angle,
    inclination_deg,
    tan_inclination,
    friction,
    frequency_hz,
    amplitude_m,
    stroke_mm,
    static_friction,
    restitution,
    air_drag,
    along_ratio,
    along_phase_deg,
    wall_friction,
    wall_pressure_ratio,
    height_over_width,
    landing_friction,
};
inline constexpr std::size_t input_count = 19;  ///< Number of inputs.

/// The name of an input in text, equal to the enumerator.
std::string_view name_of(Input input);
/// The input of this name; nothing when there is none.
std::optional<Input> input_named(std::string_view name);

/// A column of numbers for an input, which may be in a unit of its own.
struct InputColumn {
    Input input;    ///< what the numbers are
    double factor;  ///< makes a number one of the unit of the input
};

/// The column of this name: that of an input, rpm or amplitude_mm; nothing when there is none.
std::optional<InputColumn> input_column_named(std::string_view name);
/// The names of all columns.
std::vector<std::string> input_column_names();

/// The inputs given for a motion; inputs that are not given have their default values.
///
/// Required are: exactly one of throw_number, machine_number and frequency_hz, exactly one of the two
/// vibration angles, at most one of the two inclinations, and friction. The frequency needs the amplitude,
/// which is half of the stroke, and is converted with g = 9.81 m/s^2: K = omega^2 r / g. Beside a throw
/// number or a machine number the amplitude does not change the motion, but gives it a speed in m/s. A
/// vibration angle of zero is possible only without a throw number; it is replaced by tan(beta) = 1e-12,
/// which limits the accuracy of eta to about that value.
class Inputs {
  public:
    /// Gives an input its value, in the unit of the input.
    void set(Input input, double value) { value_[static_cast<std::size_t>(input)] = value; }
    /// Takes an input back; it has its default again.
    void clear(Input input) { value_[static_cast<std::size_t>(input)].reset(); }
    /// The value given; nothing when the input has its default.
    std::optional<double> get(Input input) const { return value_[static_cast<std::size_t>(input)]; }

    /// A sentence that says what is missing or given twice; std::nullopt when the set is complete.
    std::optional<std::string> incomplete() const;
    /// Whether the inputs describe Sloot & Kruyt's plastic point mass, so that the fast solver can be used.
    bool plastic() const;
    /// The amplitude r in m, from amplitude_m or stroke_mm; nothing when neither is given.
    std::optional<double> amplitude() const;
    /// omega r cos(beta) in m/s, the conveying speed at a velocity efficiency of 1; nothing without an
    /// amplitude. @throws std::invalid_argument when the set is incomplete
    std::optional<double> velocity_scale() const;
    /// @throws std::invalid_argument when the set is incomplete
    PointMass point() const;
    /// @throws std::invalid_argument when the set is not complete
    Conveyor conveyor() const;

  private:
    std::array<std::optional<double>, input_count> value_;
};

}  // namespace vibrotrough::theory
