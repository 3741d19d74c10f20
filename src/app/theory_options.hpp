#pragma once

#include "theory/point_mass.hpp"

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace vibrotrough::app {

/// A number from the command line. @throws InputError naming the option, its value and what to write instead
double read_number(std::string const& option, std::string const& text, std::string const& example);

/// An angle with a unit in rad, strictly between the bounds given in degrees. @throws InputError likewise
double read_angle(std::string const& option, std::string const& text, std::string const& example,
                  double above_deg, double below_deg);

/// The options that describe one point mass, shared by the theory's subcommands.
struct PointMassOptions {
    std::optional<std::string> throw_number;
    std::optional<std::string> vibration_angle, tan_vibration_angle;
    std::optional<std::string> inclination, tan_inclination;
    std::optional<std::string> friction;

    void add_to(CLI::App& command);
    /// @throws InputError when an option is missing, given twice in two forms, or has no sense
    theory::PointMass read() const;
};

}  // namespace vibrotrough::app
