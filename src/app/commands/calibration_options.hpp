#pragma once

#include "app/commands/option_table.hpp"
#include "app/outputs.hpp"
#include "learn/calibration.hpp"
#include "learn/calibration_report.hpp"

#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
}

namespace vibrotrough::app {

/// What the help of every calibration explains.
extern char const* const calibration_help;

/// The options that both calibrations have: on the theory, and on the surface of a layer.
struct CalibrationOptions {
    std::vector<std::string> free;    ///< names of the free parameters
    std::vector<std::string> priors;  ///< NAME=LOW:HIGH
    QuantityOptions quantities;       ///< uncertainty, common error, seed
    std::string plot, python;         ///< file of the corner plot, and the Python that draws it
    std::string page, posterior;      ///< file of the page, and of the draws for `design`
    Outputs outputs;                  ///< whether these files may replace others
    bool exact = false;               ///< without model discrepancy
    bool json = false;                ///< print JSON

    /// Declares the options of a command.
    void add_to(CLI::App& command);
    /// Reads a table of measured speeds, which no output may replace, and says on standard error which of its
    /// numbers are unusual.
    /// @throws core::InputError when a file that is there must not be replaced
    /// @throws core::InputError or core::MissingError as learn::read_speeds() and core::read_text_file() do
    std::vector<learn::MeasuredSpeed> read_speeds(std::string const& file);
    /// The free parameters, with the priors that the user gave, else those of `known`.
    /// @throws core::InputError when a name is unknown or a range has no sense
    std::vector<learn::FreeParameter> parameters(std::vector<learn::FreeParameter> const& known) const;
    /// How the calibration is made. @throws core::InputError when the seed is not a whole number
    learn::CalibrationSettings settings() const;
};

/// Splits "name=value". @throws core::InputError with the example when there is no '='
std::pair<std::string, std::string> split_setting(std::string const& option, std::string const& text,
                                                  std::string const& example);

/// Prints a calibration as the options ask, and draws its corner plot.
/// @throws core::MissingError when the plot cannot be drawn
void print_calibration(CalibrationOptions const& options, learn::Calibration const& calibration,
                       std::string const& model);

}  // namespace vibrotrough::app
