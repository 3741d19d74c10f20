#pragma once

#include "scenario/reader/case_values.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::scenario {

/// The value of one key on its way into a case or into the settings of a run: KeyAccess::set and
/// KeyAccess::set_run take it. The accessors throw std::bad_variant_access for other kinds of values. All
/// arguments must outlive it.
class GivenValue {
  public:
    /// @param where   of the key or its value, for errors
    /// @param source  where the files are that the value names
    GivenValue(Key const& key, Content const& content, FilePosition where, FileSource const& source)
        : key_(key), content_(content), where_(where), source_(source) {}

    /// The row of the key.
    Key const& key() const { return key_; }
    /// The value of a quantity or a number, in SI units; 1 for true, 0 for false.
    double number() const { return std::get<double>(content_); }
    /// number() of a key whose values are whole numbers.
    int whole() const;
    /// The value of a choice, a file or another text.
    std::string const& word() const { return std::get<std::string>(content_); }
    /// The value of a list of quantities or numbers, in SI units.
    std::vector<double> const& numbers() const { return std::get<std::vector<double>>(content_); }
    /// The value of a list of texts.
    std::vector<std::string> const& words() const { return std::get<std::vector<std::string>>(content_); }
    /// Whether the value is a word where it might also be a list.
    bool is_word() const { return std::holds_alternative<std::string>(content_); }

    /// A file that the value names: one of the given files, or read from the folder of the campaign file.
    /// @throws core::InputError when there is no such file or it is larger than 1 MiB
    NamedFile file(std::string const& name) const;
    /// The files that were read for other cases.
    FilesRead& files_read() const { return *source_.read; }
    /// @throws core::InputError of one line: position of the key, key, what is wrong, what to write instead
    [[noreturn]] void fail(std::string_view wrong, std::string_view instead) const;
    /// The same for a text that is not allowed.
    /// @param allowed  what is; empty: the range in the row of the key
    [[noreturn]] void refuse(std::string_view text, std::string_view allowed = "") const;

  private:
    Key const& key_;
    Content const& content_;
    FilePosition where_;
    FileSource const& source_;
};

/// The keys that are given for one case, for the checks of several keys: whether a key is given, and errors
/// that point to its line. All arguments must outlive it.
class GivenKeys {
  public:
    /// @param file  names the campaign file in errors
    GivenKeys(CaseValues const& values, std::string const& file) : values_(values), file_(file) {}

    /// Whether the key is given.
    bool has(std::string_view key) const { return values_.contains(key); }
    /// A number as the value of a key, in the unit in which the key is written: "12 mm".
    std::string text(std::string_view key, double value) const;
    /// The unit in which a key is given; that of the table of keys where it is not given, or without one.
    std::string_view unit(std::string_view key) const;
    /// @throws core::InputError of one line: position of the key, key, what is wrong, what to write instead
    [[noreturn]] void fail(std::string_view key, std::string_view wrong, std::string_view instead) const;
    /// Refuses a length of a key below the least that it may have.
    /// @param what  the least is: "4 diameters of the largest grains"
    void require(std::string_view key, double value, double least, std::string_view what) const;
    /// The same for a count, such as that of grains, which follows from a key.
    /// @param things   what is counted
    /// @param instead  what to write
    void require_at_most(std::string_view key, double count, double most, std::string_view things,
                         std::string_view instead) const;

  private:
    CaseValues const& values_;
    std::string const& file_;
};

/// What to write instead of a waveform that is wrong.
inline constexpr std::string_view waveform_advice =
    "write the header time_s,x_m,z_m (or time_s,ax_m_per_s2,az_m_per_s2) and at least 8 evenly spaced "
    "samples, of "
    "one cycle without the first of the next, or of several";

/// Refuses what a case cannot have together, and what is given without something that it needs.
/// @param scenario  all keys are set
/// @throws core::InputError
void check_pairs(Scenario const& scenario, GivenKeys const& given);

/// A cohesion needs a modulus: of a complete scenario, because the message names one that is stiff enough.
/// @throws core::InputError without one
void check_cohesion(Scenario const& scenario, GivenKeys const& given);

/// Works out what follows from several keys of the trough, and checks that they go together.
/// @param scenario  all keys are set
/// @throws core::InputError
void complete_trough(Scenario& scenario, GivenKeys const& given);

/// The same for the grains. @throws core::InputError
void complete_grains(Scenario& scenario, GivenKeys const& given);

/// Checks that the materials and their pairs go together, and that the layer can have them. @throws
/// core::InputError
void complete_materials(Scenario const& scenario, GivenKeys const& given);

/// Works out how long the run of a drive in stages is, and checks its stages. @throws core::InputError
void complete_stages(Scenario& scenario, GivenKeys const& given);

/// Works out how long a batch is on a screen, and checks that the rest of the case goes with it.
/// @throws core::InputError
void complete_screen(Scenario& scenario, GivenKeys const& given);

/// The same for the layer, whose number of grains follows from its height. @throws core::InputError
void complete_layer(Scenario& scenario, GivenKeys const& given);

}  // namespace vibrotrough::scenario
