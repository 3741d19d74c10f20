#pragma once

#include "learn/uncertain.hpp"
#include "theory/drive.hpp"
#include "theory/inputs.hpp"

#include <functional>
#include <initializer_list>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

namespace CLI {
class App;
}

/// @file
/// The quantities that commands take as options. Where the campaign file has a key for a quantity, its row of
/// the table of keys is the option's, too: unit, range, example and meaning.

namespace vibrotrough::app {

inline constexpr double degree = std::numbers::pi / 180;  ///< rad

/// An option as the user wrote it; none when it was not given.
using Text = std::optional<std::string>;

/// A quantity that is an option.
struct OptionRow {
    std::string name;                             ///< "--friction"
    std::string unit;                             ///< SI unit, for udunits2; empty of a plain number
    double least, most;                           ///< smallest and largest allowed value, in `unit`
    std::string example;                          ///< what to write, without quotes
    std::string meaning;                          ///< the help of the option
    bool is_whole = false;                        ///< only whole numbers
    std::optional<theory::Input> of_theory = {};  ///< that it is; none of other quantities
    double of_unit = 1;                           ///< the unit of that input in `unit`

    /// What a message says to write: '--inclination "-3 deg"'.
    std::string written_example() const;
};

/// The row of an option. @throws std::out_of_range when there is none
OptionRow const& option_row(std::string_view name);

/// A value as one of a row. @throws core::InputError naming the option, its value and what to write instead
double read_option(std::string_view name, std::string const& text);

/// "LOW to HIGH" or "LOW-HIGH", where the unit may stand once, or one value for both.
/// @throws core::InputError as read_option, and when the first value is above the second
theory::Range read_option_range(std::string_view name, std::string const& text);

/// A value that may not be exact: "0.3", with its standard uncertainty "0.3+-0.03" or "0.3 +- 0.03", or
/// anything within a range, "0.25 to 0.35". A unit may stand once. @throws core::InputError as read_option
learn::Uncertain read_uncertain_option(std::string_view name, std::string const& text);

/// The options of a command that are rows of the table.
class QuantityOptions {
  public:
    /// An option, and what its help says besides the meaning of its row, or instead of it.
    struct Wanted {
        char const* name;          ///< of a row
        char const* more = "";     ///< behind the meaning
        char const* instead = "";  ///< of the meaning
    };

    /// Declares options. @param group  their heading in the help; empty: the usual one
    void add_to(CLI::App& command, std::initializer_list<Wanted> wanted, std::string const& group = "");
    /// Declares all inputs of the theory that Sloot & Kruyt's plastic point mass does not have.
    void add_beyond_plastic(CLI::App& command, std::string const& group);
    /// What the user wrote for an option that was declared.
    Text const& text(std::string const& name) const { return texts_.at(name); }
    /// Whether any was given.
    bool is_any() const;
    /// Whether it was given.
    bool has(std::string const& name) const { return texts_.at(name).has_value(); }
    /// Puts a text in place of what the user wrote, or of what was not given, where the option is declared.
    void set(std::string const& name, std::string const& text);
    /// The same where the user wrote nothing.
    void set_if_missing(std::string const& name, std::string const& text);
    /// Its value in the SI unit; none when it was not given. @throws core::InputError as read_option
    std::optional<double> value(std::string const& name) const;
    /// The same of an option that must be given. @throws core::InputError when it is missing
    double required(std::string const& name) const;
    /// What may not be exact; none when it was not given. @throws core::InputError as read_option
    std::optional<learn::Uncertain> uncertain(std::string const& name) const;
    /// Puts all options that were given into the theory's inputs.
    void set_inputs(theory::Inputs& inputs) const;
    /// @throws core::InputError when both of two options are given that say the same
    void refuse_both(std::string const& first, std::string const& second) const;

  private:
    std::map<std::string, Text> texts_;
};

/// @throws core::InputError when both of two options are given that say the same
void refuse_both(std::string const& first, Text const& a, std::string const& second, Text const& b);

/// The text of an option that must be given. @throws core::InputError with an example when it is missing
std::string required(std::string const& option, Text const& text, std::string const& example);

/// Reads a number within [low, high] from the command line.
/// @throws core::InputError naming the option, its value and what to write instead
double read_number_within(std::string const& option, std::string const& text, std::string const& example,
                          double low, double high);

/// Reads a number of any size. @throws core::InputError as read_number_within
double read_number(std::string const& option, std::string const& text, std::string const& example);

/// Reads a whole number within [low, high]. @throws core::InputError as read_number_within
int read_count(std::string const& option, std::string const& text, std::string const& example, int low,
               int high);

/// Reads a quantity above zero with its unit and converts it to `unit`.
/// @throws core::InputError as read_number_within
double read_positive_quantity(std::string const& option, std::string const& text, std::string const& unit,
                              std::string const& example);

/// Reads a flow above zero in kg/s. A flow of volume, such as "20 m3/h", is one of mass at the bulk density.
/// @param bulk_density  kg/m3; without it, a flow of volume is refused
/// @throws core::InputError as read_number_within
double read_mass_flow(std::string const& option, std::string const& text, std::optional<double> bulk_density);

/// Whether a flow is one of volume, such as "20 m3/h".
bool is_volume_flow(std::string const& text);

/// Reads the speed of a motor's shaft in turns per minute, "960" or "960 rpm", as cycles per second (Hz).
/// @throws core::InputError as read_number_within
double read_turns(std::string const& option, std::string const& text);

/// Reads "LOW to HIGH" or "LOW-HIGH", where the unit may stand once, or one value for both.
/// @param read_one  reads one value
/// @throws core::InputError as read_one does, and when the first value is above the second
theory::Range read_range(std::string const& option, std::string const& text, std::string const& example,
                         std::function<double(std::string const&)> const& read_one);

/// "20 deg" of "10 deg to 20 deg"; the text itself when it is not a range.
std::string last_of_range(std::string const& text);

}  // namespace vibrotrough::app
