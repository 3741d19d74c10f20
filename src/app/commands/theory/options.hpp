#pragma once

#include "app/commands/option_table.hpp"
#include "theory/conveyor.hpp"
#include "theory/drive.hpp"
#include "theory/inputs.hpp"
#include "theory/quantities.hpp"
#include "theory/rolling_layer.hpp"
#include "theory/unusual.hpp"

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class Option;
}

namespace vibrotrough::app {

/// Says on standard error which numbers are unusual, and which slip would explain it.
void tell_unusual(theory::MachineNumbers const& numbers);

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
    std::optional<double> amplitude() const;
    std::optional<double> frequency() const;
    double gravity() const;
    void set_frequency(theory::Inputs& inputs) const;

    QuantityOptions quantities_;
    Text rpm_;
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

/// How many starts of each motion --starts asks for; 0 without it.
/// @throws core::InputError when it is wrong, or given for a rolling layer
int count_starts(QuantityOptions const& options, bool rolling_layer);

/// Says on standard error that `count` of `all` points are outside the tested range and withheld; nothing
/// when none is.
void tell_withheld(std::size_t count, std::size_t all);

/// @throws core::InputError naming the option when the inputs are not complete
void require_complete(theory::Inputs const& inputs);

/// @throws core::InputError when a motion has more than the rolling-layer law knows
void require_plastic(TheoryOptions const& motion);

}  // namespace vibrotrough::app
