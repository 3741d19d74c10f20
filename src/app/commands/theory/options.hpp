#pragma once

#include "theory/conveyor.hpp"
#include "theory/drive.hpp"
#include "theory/inputs.hpp"
#include "theory/quantities.hpp"
#include "theory/rolling_layer.hpp"
#include "theory/unusual.hpp"

#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace vibrotrough::app {

inline constexpr double degree = std::numbers::pi / 180;  ///< rad

/// An option as the user wrote it; none when it was not given.
using Text = std::optional<std::string>;

/// Says on standard error which numbers are unusual, and which slip would explain it.
void tell_unusual(theory::MachineNumbers const& numbers);

/// @throws core::InputError when both of two options are given that say the same
void refuse_both(std::string const& first, Text const& a, std::string const& second, Text const& b);

/// Reads a number from the command line.
/// @throws core::InputError naming the option, its value and what to write instead
double read_number(std::string const& option, std::string const& text, std::string const& example);

/// Reads a number within [low, high]. @throws core::InputError as read_number
double read_number_within(std::string const& option, std::string const& text, std::string const& example,
                          double low, double high);

/// Reads a whole number within [low, high]. @throws core::InputError as read_number
int read_count(std::string const& option, std::string const& text, std::string const& example, int low,
               int high);

/// Reads a quantity above zero with its unit and converts it to `unit`. @throws core::InputError as
/// read_number
double read_positive_quantity(std::string const& option, std::string const& text, std::string const& unit,
                              std::string const& example);

/// The same for a quantity within [low, high] of `unit`. The message has the range in the unit that was
/// written, and the slip of a unit that would explain the number.
/// @throws core::InputError as read_number
double read_quantity_within(std::string const& option, std::string const& text, std::string const& unit,
                            std::string const& example, double low, double high);

/// Reads a flow above zero in kg/s. A flow of volume, such as "20 m3/h", is one of mass at the bulk density.
/// @param bulk_density  kg/m3; without it, a flow of volume is refused
/// @throws core::InputError as read_number
double read_mass_flow(std::string const& option, std::string const& text, std::optional<double> bulk_density);

/// Reads the speed of a motor's shaft in turns per minute, "960" or "960 rpm", as cycles per second (Hz).
/// @throws core::InputError as read_number
double read_turns(std::string const& option, std::string const& text);

/// Reads "LOW to HIGH" or "LOW-HIGH", where the unit may stand once, or one value for both.
/// @param read_one  reads one value
/// @throws core::InputError as read_one does, and when the first value is above the second
theory::Range read_range(std::string const& option, std::string const& text, std::string const& example,
                         std::function<double(std::string const&)> const& read_one);

/// "20 deg" of "10 deg to 20 deg"; the text itself when it is not a range.
std::string last_of_range(std::string const& text);

/// Reads an angle with its unit and converts it to rad. The bounds, both excluded, are in degrees; the
/// message has them in the unit that was written.
/// @throws core::InputError as read_number
double read_angle(std::string const& option, std::string const& text, std::string const& example,
                  double low_deg, double high_deg);

/// The text of an option that must be given. @throws core::InputError with an example when it is missing
std::string required(std::string const& option, Text const& text, std::string const& example);

/// The options that describe a motion, shared by the theory commands.
class TheoryOptions {
  public:
    /// Declares the options of a command.
    void add_to(CLI::App& command);

    /// The inputs that were given. Each number is checked by itself.
    /// @throws core::InputError when one is wrong or given in two forms
    theory::Inputs given() const;
    /// The complete description of a motion.
    /// @throws core::InputError when an input is missing, wrong or given in two forms
    theory::Conveyor conveyor() const;
    /// Whether only the plastic point mass is asked for, without any extension.
    bool plastic() const;
    /// The machine that gives the motion its units, without a layer: amplitude or stroke as given, or the
    /// amplitude that follows from the frequency; none when no amplitude is known.
    /// @throws core::InputError when an option is wrong
    std::optional<theory::Machine> machine() const;
    /// Says on standard error which numbers are unusual, and which slip would explain it.
    /// @param bulk_density  kg/m3, of the layer, where it is known
    /// @throws core::InputError when an option is wrong
    void tell_unusual(std::optional<double> bulk_density = {}) const;

  private:
    void add_extensions(CLI::App& command);
    void add_machine(CLI::App& command);
    void set_drive(theory::Inputs& inputs) const;
    std::optional<double> amplitude() const;
    std::optional<double> frequency() const;
    double gravity() const;

    Text throw_number_, machine_number_;
    Text vibration_angle_, tan_vibration_angle_;
    Text inclination_, tan_inclination_;
    Text friction_;
    Text frequency_, rpm_, amplitude_, stroke_, gravity_;
    Text static_friction_, landing_friction_, restitution_, slowest_rebound_, air_drag_;
    Text along_ratio_, along_phase_;
    Text wall_friction_, wall_pressure_ratio_, height_over_width_;
    std::vector<std::string> along_, normal_;
    bool table_1_rule_ = false;
};

/// The option --rolling-layer [NAME=VALUE,...], shared by the commands that can solve rolling layers.
class RollingOption {
  public:
    /// Declares the option of a command.
    void add_to(CLI::App& command);
    /// The law with the constants that were given; nothing without the option.
    /// @throws core::InputError when a name is unknown or a value is wrong
    std::optional<theory::RollingLaw> law() const;
    /// Whether answers where the law has not been tested are wanted, too (--accept-untested).
    bool accepts_untested() const { return accepts_untested_; }

  private:
    std::string text_;
    bool accepts_untested_ = false;
    CLI::Option* option_ = nullptr;
};

/// The option --starts of the commands that solve many motions.
class StartsOption {
  public:
    /// Declares the option of a command.
    void add_to(CLI::App& command);
    /// How many starts to follow; 0 without the option. @throws core::InputError when it is wrong, or given
    /// for a rolling layer
    int count(bool rolling_layer) const;

  private:
    Text text_;
};

/// Says on standard error that `count` of `all` points are outside the tested range and withheld; nothing
/// when none is.
void tell_withheld(std::size_t count, std::size_t all);

/// @throws core::InputError naming the option when the inputs are not complete
void require_complete(theory::Inputs const& inputs);

}  // namespace vibrotrough::app
