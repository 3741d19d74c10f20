#pragma once

#include "store/case_record.hpp"

#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

/// The one table of what the store's files hold; README.md of this room prints the same, and a test compares
/// both with files that were really written.
namespace vibrotrough::store {

/// What a reader needs to know of a dataset. Its type follows from its value.
struct Entry {
    std::string_view name;
    std::string_view units;  ///< "1" for pure numbers and texts
    std::string_view meaning;
};

/// The way to one field of a record. The same entry of the schema reads the field of a record that is written
/// to a file and fills the field of a record that is read back.
template <typename Record, typename Value>
class Field {
  public:
    /// @param path  a lambda without captures: [](auto& record) -> auto& { return record.part.field; }
    template <typename Path>
    requires std::is_empty_v<Path> && std::default_initializable<Path> Field(Path)
        : read_([](Record const& record) -> Value const& { return Path{}(record); }),
          change_([](Record& record) -> Value& { return Path{}(record); }) {}

    Value const& operator()(Record const& record) const { return read_(record); }
    Value& operator()(Record& record) const { return change_(record); }

  private:
    Value const& (*read_)(Record const&);
    Value& (*change_)(Record&);
};

/// The field that a path leads to, with the type that it has in the record.
template <typename Record, typename Path>
auto field_of(Path path) {
    return Field<Record, std::remove_reference_t<decltype(path(std::declval<Record&>()))>>(path);
}

template <typename Path>
auto case_field(Path path) {
    return field_of<CaseRecord>(path);
}

template <typename Path>
auto packing_field(Path path) {
    return field_of<PackingRecord>(path);
}

/// Texts that say which case this is and where it was made: root attributes of result.h5, columns of
/// campaign.h5.
struct CaseFact {
    Entry entry;
    std::variant<Field<CaseRecord, std::string>, Field<CaseRecord, core::Outcome>> field;
};

/// One number of a case: `case/<name>` of result.h5, a column of campaign.h5.
struct CaseValue {
    Entry entry;
    std::variant<int (*)(CaseRecord const&), std::optional<double> (*)(CaseRecord const&),
                 std::string (*)(CaseRecord const&)>
        value;
};

/// One value per packing: `packings/<name>` of result.h5.
struct PackingValue {
    Entry entry;
    std::variant<Field<PackingRecord, int>, Field<PackingRecord, double>,
                 Field<PackingRecord, std::optional<double>>, Field<PackingRecord, std::string>,
                 Field<PackingRecord, measure::Verdict>>
        field;
};

enum class SeriesLength {
    cycles,      ///< one value per cycle 1 ... n
    cycle_ends,  ///< one value per end of cycle 0 ... n
};

/// One series of a packing: `series/<packing>/<name>` of result.h5, packings counted from 1.
struct PackingSeries {
    Entry entry;
    SeriesLength length;
    Field<PackingRecord, std::vector<double>> field;
};

/// One column of a table of a packing: `<group>/<packing>/<name>` of result.h5. All columns of a group have
/// the same length.
struct PackingTable {
    std::string_view group;
    Entry entry;
    Field<PackingRecord, std::vector<double>> field;
};

std::vector<CaseFact> const& case_facts();
std::vector<CaseValue> const& case_values();
std::vector<PackingValue> const& packing_values();
std::vector<PackingSeries> const& packing_series();
std::vector<PackingTable> const& packing_tables();

/// The frozen scenario as TOML, dataset `scenario` of result.h5.
Entry scenario_entry();

/// The certificate of the engine binary as JSON, dataset `engine_certificate` of result.h5.
Entry certificate_entry();

/// The files that the scenario names, as a JSON object of names and contents, dataset `scenario_files`.
Entry scenario_files_entry();

/// "precise", "not-precise" or "not-steady".
std::string verdict_name(measure::Verdict verdict);

/// @throws Hdf5Error when the name is none of them
measure::Verdict verdict_of(std::string const& name);

/// A value as the files hold it: a number that does not exist is NaN there, and a verdict is its name.
int to_stored(int value);
double to_stored(double value);
double to_stored(std::optional<double> const& value);
std::string to_stored(std::string const& value);
std::string to_stored(measure::Verdict value);
std::string to_stored(core::Outcome value);

/// The way back from what a file holds. A number that is not finite does not exist.
void from_stored(int stored, int& value);
void from_stored(double stored, double& value);
void from_stored(double stored, std::optional<double>& value);
void from_stored(std::string const& stored, std::string& value);
/// @throws Hdf5Error when no outcome with a result has this name
void from_stored(std::string const& stored, core::Outcome& value);
/// @throws Hdf5Error when there is no such verdict
void from_stored(std::string const& stored, measure::Verdict& value);

}  // namespace vibrotrough::store
