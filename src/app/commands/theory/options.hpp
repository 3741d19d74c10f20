#pragma once

#include "theory/conveyor.hpp"
#include "theory/inputs.hpp"

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace vibrotrough::app {

using Text = std::optional<std::string>;

/// A number from the command line. @throws InputError naming the option, its value and what to write instead
double read_number(std::string const& option, std::string const& text, std::string const& example);

/// Likewise, within [low, high].
double read_number_within(std::string const& option, std::string const& text, std::string const& example,
                          double low, double high);

/// A whole number within [low, high]. @throws InputError likewise
int read_count(std::string const& option, std::string const& text, std::string const& example, int low,
               int high);

/// A quantity with a unit, in `unit`, above zero. @throws InputError likewise
double read_positive_quantity(std::string const& option, std::string const& text, std::string const& unit,
                              std::string const& example);

/// An angle with a unit in rad, between the bounds in degrees. @throws InputError likewise
double read_angle(std::string const& option, std::string const& text, std::string const& example,
                  double low_deg, double high_deg);

/// The text of an option that must be there. @throws InputError with an example when it is missing
std::string required(std::string const& option, Text const& text, std::string const& example);

/// The options that describe a motion, shared by the theory's subcommands.
class TheoryOptions {
  public:
    enum class Extent {
        plastic,   ///< Sloot & Kruyt's point mass with plastic landing only
        complete,  ///< all that the theory knows
    };
    void add_to(CLI::App& command, Extent extent);

    /// What was given, each number checked alone. @throws InputError
    theory::Inputs given() const;
    /// The whole description. @throws InputError when something is missing or given in two forms
    theory::Conveyor conveyor() const;
    /// Nothing beyond the plastic point mass is asked for.
    bool plastic() const;
    theory::PointMass point() const { return conveyor().point; }

  private:
    void add_extensions(CLI::App& command);

    Text throw_number_, machine_number_;
    Text vibration_angle_, tan_vibration_angle_;
    Text inclination_, tan_inclination_;
    Text friction_;
    Text static_friction_, landing_friction_, restitution_, slowest_rebound_, air_drag_;
    Text along_ratio_, along_phase_;
    Text wall_friction_, wall_pressure_ratio_, height_over_width_;
    std::vector<std::string> along_, normal_;
    bool table_1_rule_ = false;
};

/// Says in the words of the command line what a set of inputs lacks. @throws InputError when it lacks
/// anything
void require_complete(theory::Inputs const& inputs);

}  // namespace vibrotrough::app
