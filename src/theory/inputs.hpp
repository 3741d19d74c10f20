#pragma once

#include "theory/conveyor.hpp"

#include <array>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
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
    restitution,
    slowest_rebound,
    static_friction,
    landing_friction,
    air_drag,
    along_ratio,
    along_phase_deg,
    wall_friction,
    wall_pressure_ratio,
    height_over_width,
};

/// The member of a Conveyor that an input gives; none of the inputs of Sloot & Kruyt's plastic point mass.
using InputMember = std::variant<std::monostate, double Conveyor::*, std::optional<double> Conveyor::*>;

/// What is known of an input. Range, example and meaning are those of its option on the command line, too.
struct InputRow {
    std::string_view name;          ///< equal to the enumerator
    InputMember member = {};        ///< the other fields are only of inputs that have one
    double least = 0, most = 0;     ///< range, in the unit of the input
    std::string_view example = {};  ///< what to write, for example
    std::string_view meaning = {};  ///< with its default value
    double least_but_zero = 0;      ///< values between 0 and this one are refused
    double factor = 1;              ///< makes a number one of the unit of the member
};

/// All inputs, in the order of the enumerators. The ranges of those without a member are in
/// detail/ranges.cpp.
inline constexpr std::array input_rows{
    InputRow{"throw_number"},
    InputRow{"machine_number"},
    InputRow{"vibration_angle_deg"},
    InputRow{"tan_vibration_angle"},
    InputRow{"inclination_deg"},
    InputRow{"tan_inclination"},
    InputRow{"friction"},
    InputRow{"frequency_hz"},
    InputRow{"amplitude_m"},
    InputRow{"stroke_mm"},
    InputRow{"restitution", &Conveyor::restitution, 0, largest_restitution, "0.2",
             "e, normal restitution coefficient, from 0 (plastic, default) to 0.95 (Eq. 23)"},
    InputRow{"slowest_rebound", &Conveyor::slowest_rebound, 1e-9, 1, "1e-6",
             "Rebounds slower than this count as contact, in omega r sin(beta); default: 1e-6"},
    InputRow{"static_friction", &Conveyor::static_friction, 0, 1e6, "0.4",
             "Static friction coefficient, at least --friction, which is then the kinetic one"},
    InputRow{"landing_friction", &Conveyor::landing_friction, 0, 1e6, "0.1",
             "Friction coefficient during a landing: the ratio of tangential to normal impulse that it can "
             "reach; default: mu"},
    InputRow{"air_drag", &Conveyor::air_drag, 0, 1000, "0.01",
             "kappa: the drag force is m omega kappa times the velocity", 1e-8},
    InputRow{"along_ratio", &Conveyor::along_ratio, -1000, 1000, "0.8",
             "Elliptical drive: amplitude along the trough over r cos(beta)"},
    InputRow{"along_phase_deg", &Conveyor::along_phase, -5729, 5729, "90",
             "Elliptical drive: phase of the motion along the trough", 0, std::numbers::pi / 180},
    InputRow{"wall_friction", &Conveyor::wall_friction, 0, 1000, "0.3",
             "Friction coefficient of the layer on the side walls"},
    InputRow{"wall_pressure_ratio", &Conveyor::wall_pressure_ratio, 0, 1, "0.5",
             "Janssen's k, horizontal over vertical stress; default: 0.5"},
    InputRow{"height_over_width", &Conveyor::height_over_width, 0, 1000, "0.2",
             "Height of the layer over its width, for side-wall friction"},
};
inline constexpr std::size_t input_count = input_rows.size();  ///< Number of inputs.
static_assert(input_count == static_cast<std::size_t>(Input::height_over_width) + 1);

/// The row of an input.
constexpr InputRow const& row_of(Input input) {
    return input_rows[static_cast<std::size_t>(input)];
}
/// The name of an input in text, equal to the enumerator.
constexpr std::string_view name_of(Input input) {
    return row_of(input).name;
}
/// Whether Sloot & Kruyt's plastic point mass does not have this input.
constexpr bool is_beyond_plastic(Input input) {
    return row_of(input).member.index() != 0;
}
/// The input of this name; nothing when there is none.
std::optional<Input> input_named(std::string_view name);
/// The value that a conveyor has for a row, in the unit of the input; nothing where it has none.
std::optional<double> value_in(Conveyor const& conveyor, InputRow const& row);

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
