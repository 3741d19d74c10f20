#pragma once

#include "store/case_record.hpp"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

/// @file
/// A number or word of a result is described once, in one row: a Quantity. The files, the columns of
/// `compare`, the report and `vibrotrough quantities` follow from the rows.

namespace vibrotrough::store {

/// The way to one field of a record. The same row of the schema reads the field of a record that is written
/// to a file and fills the field of a record that is read back.
template <typename Record, typename Value>
class Field {
  public:
    /// Takes a function of a record that may be constant or not: [](auto& record) -> auto& { ... }
    template <typename Path>
    explicit Field(Path path)
        : read_([path](Record const& record) -> Value const& { return path(record); }),
          change_([path](Record& record) -> Value& { return path(record); }) {}

    /// The field of a record that is read.
    Value const& operator()(Record const& record) const { return read_(record); }
    /// The field of a record that is filled.
    Value& operator()(Record& record) const { return change_(record); }

  private:
    std::function<Value const&(Record const&)> read_;
    std::function<Value&(Record&)> change_;
};

/// The field that pointers to members lead to: one of the record, one of that member, and so on.
template <typename Record, typename Member, typename... Rest>
auto field(Member Record::*first, Rest... rest) {
    using Value = std::remove_reference_t<decltype(((std::declval<Record&>().*first).*....*rest))>;
    return Field<Record, Value>([=](auto& record) -> auto& { return ((record.*first).*....*rest); });
}

/// A number of a packing that does not always exist.
using MeasuredNumber = Field<PackingRecord, std::optional<double>>;

/// How the terminal's table shows a column.
struct TerminalView {
    std::string_view heading;          ///< first line above the column
    std::string_view subheading = "";  ///< the line below it: the unit, or a remark
    int priority = 1;  ///< the column with the smallest is left out first when the terminal is too narrow
    bool flush_left = false;       ///< aligned to the left, for texts of different length
    bool only_when_known = false;  ///< left out when no case has a value
};

constexpr double tonnes_per_hour = 3.6;  ///< in one kg/s

/// Columns of this priority are never left out of the terminal's table.
constexpr int always_shown = 9;

/// How the report's table shows a column.
struct ReportView {
    std::string_view heading;  ///< above the column
    /// When all cases have the same value, one sentence gives it instead of a column.
    bool once_when_same = false;
};

/// One column of `compare`, and so of JSON, CSV, the VTK table and, where it says so, of tables for people.
struct View {
    std::string_view unit = "";                 ///< empty: that of the quantity
    double factor = 1;                          ///< of the values in this unit against those of the quantity
    std::string_view format = "{}";             ///< of a value in tables for people, for both fmt and Python
    std::optional<TerminalView> terminal = {};  ///< none: not in the terminal's table
    std::optional<ReportView> report = {};      ///< none: not in the report's table
};

/// How the value of a case follows from the values of its packings. The mean and the largest are taken over
/// the packings that have a value; without any the case has none.
enum class OverPackings {
    nothing,  ///< the value belongs to packings alone, or to the case alone
    mean,     ///< the mean
    largest,  ///< the largest
    sum,      ///< the sum
};

/// A value of a case. A number that does not exist is NaN in the files, a word that does not exist is empty.
using CaseNumber = std::variant<int, std::optional<double>, std::string>;

/// One number or word of a result: `case/<name>` or `packings/<name>` of result.h5 or both, a column of
/// campaign.h5, and the columns of `compare` that its views describe.
struct Quantity {
    using Integer = std::function<int(CaseRecord const&)>;                 ///< computes a whole number
    using Real = std::function<std::optional<double>(CaseRecord const&)>;  ///< computes a number
    using Text = std::function<std::string(CaseRecord const&)>;            ///< computes a word
    /// Computes the value of a case from its record, or leads to the value of a packing in its record.
    using Of = std::variant<Integer, Real, Text, Field<PackingRecord, int>, Field<PackingRecord, double>,
                            MeasuredNumber, Field<PackingRecord, std::string>,
                            Field<PackingRecord, measure::Verdict>>;

    std::string_view name;     ///< the same wherever it is; columns of text files add their unit
    std::string_view units;    ///< in the spelling of udunits2; "1" for pure numbers and texts
    std::string_view meaning;  ///< for people; of a packing when it is a value of packings
    Of of;                     ///< leads to the value
    OverPackings over_packings = OverPackings::nothing;  ///< what is made of the values of packings
    std::vector<View> views = {};                        ///< its columns in `compare`
    bool known_without_mean = false;  ///< `compare` shows it also of a case that has no mean

    /// Whether each packing has a value.
    bool is_of_packings() const { return of.index() >= 3; }
    /// Whether the case has a value.
    bool is_of_case() const { return !is_of_packings() || over_packings != OverPackings::nothing; }
    /// The value of a case. @pre is_of_case()
    CaseNumber of_case(CaseRecord const& record) const;
    /// A value of the type that of_case() returns.
    CaseNumber type_of_case() const;
    /// The meaning of the case's value, which tells how it follows from those of the packings.
    std::string meaning_of_case() const;
};

/// All quantities, in the order of the files.
std::vector<Quantity> const& quantities();

/// Applies a function to the field of packings that the quantity leads to; does nothing for one of the case
/// alone.
template <typename Function>
void for_packings(Quantity const& quantity, Function const& function) {
    std::visit(
        [&]<typename Way>(Way const& way) {
            if constexpr (!std::is_invocable_v<Way, CaseRecord const&>) function(way);
        },
        quantity.of);
}

/// The mean over the packings that have this number; none when no packing has it.
std::optional<double> mean_over_packings(CaseRecord const& record, MeasuredNumber const& number);

/// Half-width of Student's interval of that mean at measure.confidence; none with fewer than two values.
std::optional<double> half_width_over_packings(CaseRecord const& record, MeasuredNumber const& number);

/// The names of a number of the packings and of the half-width of its interval.
struct MeasuredNames {
    std::string_view name, half_width;  ///< of the number, of the half-width
};

/// Adds a number of the packings and the half-width of its interval, with one column each.
/// @param view  of the number; that of the half-width has the same unit
void add_measured(std::vector<Quantity>& rows, MeasuredNumber const& number, MeasuredNames const& names,
                  std::string_view units, std::string_view meaning, View const& view);

/// A column of the terminal's table that is left out when no case has a value.
constexpr TerminalView terminal_when_known(std::string_view heading, std::string_view subheading = "") {
    return {.heading = heading, .subheading = subheading, .priority = 4, .only_when_known = true};
}

}  // namespace vibrotrough::store
