#pragma once

#include "store/case_record.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// @file
/// Observables: quantities that a person defines as functions in Python ('vibrotrough observe'). The program
/// knows of one what its row says, and makes its mean and interval as those of its own quantities.

namespace vibrotrough::store {

class Hdf5Writer;

/// The mean of an observable over the packings of a case, or of one point of its curve.
struct ObservedValue {
    std::optional<double> mean;        ///< none where a curve has no value
    std::optional<double> half_width;  ///< of its interval at measure.confidence; none when it is unbounded
    std::string steadiness;            ///< steady, drifting or branching, see measure::Steadiness
};

/// What an observable came to in one case.
struct ObservedCase {
    std::string id;                     ///< of the case
    std::string result;                 ///< mark_of() of the result that it belongs to
    std::vector<int> packings;          ///< numbers of those that were measured
    int discarded = 0;                  ///< cycles of each packing that are left out as start-up
    int measured = 0;                   ///< cycles of each packing that are kept
    std::vector<double> at;             ///< where the points of a curve are; empty for a number
    std::vector<ObservedValue> values;  ///< one for a number, else one for each point
};

/// An observable and what it came to in the cases of a campaign.
struct Observable {
    std::string name;                      ///< of the function
    std::string unit;                      ///< in the spelling of udunits2; "1" for pure numbers
    std::string meaning;                   ///< one line: the first of the function's docstring
    std::string over = {};                 ///< what a curve is drawn over; empty for a number
    std::string over_unit = {};            ///< of that
    std::string file = {};                 ///< name of the person's file
    std::string source = {};               ///< its text
    std::string sha256 = {};               ///< SHA-256 of the text
    std::vector<ObservedCase> cases = {};  ///< in the order of the campaign

    /// Whether it is a number and not a curve.
    bool is_number() const { return over.empty(); }
    /// What it came to in this result of a case; null when it was not measured there, or in an earlier result
    /// of the case.
    ObservedCase const* of(CaseRecord const& record) const;
};

/// Whether an observable can have this name: lower-case letters, digits and _, at most 60 of them.
bool is_observable_name(std::string_view name);

/// Whether a unit is one that udunits2 knows, written in plain letters.
bool is_plain_unit(std::string const& unit);

/// A text that changes when packings or cycles of a result change. It is the same for the result and for its
/// summary.
std::string mark_of(CaseRecord const& record);

/// The word for a steadiness.
std::string_view name_of(measure::Steadiness steadiness);

/// Adds the group observables/NAME of each observable to campaign.h5.
/// @param cases  those of the file, in its order
void add_observables(Hdf5Writer& file, std::span<CaseRecord const> cases,
                     std::span<Observable const> observables);

/// A dataset below observables/NAME, for the reference.
struct ObservableEntry {
    std::string_view name;     ///< behind observables/NAME/
    std::string_view type;     ///< float64, int32 or text
    std::string_view shape;    ///< what there is one value of
    std::string_view units;    ///< of the values
    std::string_view meaning;  ///< for people
};

/// All of them.
std::span<ObservableEntry const> observable_entries();

}  // namespace vibrotrough::store
