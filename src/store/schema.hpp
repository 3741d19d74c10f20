#pragma once

#include "measure/mass_flow.hpp"
#include "scenario/reader/keys.hpp"
#include "store/case_record.hpp"

#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

/// @file
/// The table of everything in the store's files. The README of this room has the same table, and a test
/// compares both with files that were written.

namespace vibrotrough::store {

/// The description of a dataset or field. Its type follows from its value.
struct Entry {
    std::string_view name;     ///< of the dataset or field
    std::string_view units;    ///< "1" for pure numbers and texts
    std::string_view meaning;  ///< for people; the attribute `description`
};

/// The way to one field of a record. The same entry of the schema reads the field of a record that is written
/// to a file and fills the field of a record that is read back.
template <typename Record, typename Value>
class Field {
  public:
    /// Takes a lambda without captures: [](auto& record) -> auto& { return record.part.field; }
    template <typename Path>
    requires std::is_empty_v<Path> && std::default_initializable<Path> Field(Path)
        : read_([](Record const& record) -> Value const& { return Path{}(record); }),
          change_([](Record& record) -> Value& { return Path{}(record); }) {}

    /// The field of a record that is read.
    Value const& operator()(Record const& record) const { return read_(record); }
    /// The field of a record that is filled.
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

/// A field of a case's record.
template <typename Path>
auto case_field(Path path) {
    return field_of<CaseRecord>(path);
}

/// A field of a packing's record.
template <typename Path>
auto packing_field(Path path) {
    return field_of<PackingRecord>(path);
}

/// A text that identifies a case or tells where it was made: a root attribute of result.h5, a column of
/// campaign.h5.
struct CaseFact {
    Entry entry;  ///< its description
    /// Its place in the record.
    std::variant<Field<CaseRecord, std::string>, Field<CaseRecord, core::Outcome>> field;
};

/// One number of a case: `case/<name>` of result.h5, a column of campaign.h5.
struct CaseValue {
    Entry entry;  ///< its description
    /// A function that computes a value of a case from its record.
    using Function = std::variant<int (*)(CaseRecord const&), std::optional<double> (*)(CaseRecord const&),
                                  std::string (*)(CaseRecord const&)>;
    Function value;  ///< computes it from the record
};

/// One value per packing: `packings/<name>` of result.h5.
struct PackingValue {
    Entry entry;  ///< its description
    /// Its place in the record.
    std::variant<Field<PackingRecord, int>, Field<PackingRecord, double>,
                 Field<PackingRecord, std::optional<double>>, Field<PackingRecord, std::string>,
                 Field<PackingRecord, measure::Verdict>>
        field;
    bool may_be_missing = false;  ///< files of 0.2.0 that were written before it was added do not have it
};

/// The length of a series of n cycles.
enum class SeriesLength {
    cycles,      ///< one value per cycle 1 ... n
    cycle_ends,  ///< one value per end of cycle 0 ... n
};

/// One series of a packing: `series/<packing>/<name>` of result.h5, packings counted from 1.
struct PackingSeries {
    Entry entry;                                      ///< its description
    SeriesLength length;                              ///< its number of values
    Field<PackingRecord, std::vector<double>> field;  ///< its place in the record
};

/// One column of a table of a packing: `<group>/<packing>/<name>` of result.h5. All columns of a group have
/// the same length.
struct PackingTable {
    std::string_view group;                           ///< of columns with the same length
    Entry entry;                                      ///< its description
    Field<PackingRecord, std::vector<double>> field;  ///< its place in the record
};

/// One column of the table `mass_flow` of a case: `mass_flow/<name>` of result.h5. It follows from the
/// packings, so that it is written and not read.
struct MassFlowColumn {
    Entry entry;                                    ///< its description
    std::vector<double> measure::MassFlow::*field;  ///< its place in the mass flow
};

/// All facts of a case, in the order of the files.
std::vector<CaseFact> const& case_facts();
/// All values of a case, in the order of the files.
std::vector<CaseValue> const& case_values();
/// All values of each packing, in the order of the files.
std::vector<PackingValue> const& packing_values();
/// All series of a packing.
std::vector<PackingSeries> const& packing_series();
/// All columns of the tables of a packing.
std::vector<PackingTable> const& packing_tables();
/// The columns of the table `rolling` of a packing, which only a case with measure.rolling has.
std::vector<PackingTable> const& rolling_tables();

/// The columns of the table `mass_flow`.
std::vector<MassFlowColumn> const& mass_flow_columns();

/// The mass flow over depth of a case, from the profiles of its packings.
measure::MassFlow mass_flow_of(CaseRecord const& record);

/// The frozen scenario as TOML, dataset `scenario` of result.h5.
Entry scenario_entry();

/// The certificate of the engine binary as JSON, dataset `engine_certificate` of result.h5.
Entry certificate_entry();

/// The files that the scenario names, as a JSON object of names and contents, dataset `scenario_files`.
Entry scenario_files_entry();

/// The values of a swept key, a dataset `swept/<key>` of campaign.h5. Angles are in rad.
Entry swept_entry(scenario::Key const& key);

/// "precise", "not-precise" or "not-steady".
std::string verdict_name(measure::Verdict verdict);

/// The verdict of a name. @throws Hdf5Error when there is no such verdict
measure::Verdict verdict_of(std::string const& name);

/// The value in the form of the files.
int to_stored(int value);
/// The value in the form of the files.
double to_stored(double value);
/// The value in the form of the files: NaN when it does not exist.
double to_stored(std::optional<double> const& value);
/// The value in the form of the files.
std::string to_stored(std::string const& value);
/// The value in the form of the files: its name.
std::string to_stored(measure::Verdict value);
/// The value in the form of the files: its name.
std::string to_stored(core::Outcome value);

/// Sets `value` from the form of the files.
void from_stored(int stored, int& value);
/// Sets `value` from the form of the files.
void from_stored(double stored, double& value);
/// Sets `value` from the form of the files. A number that is not finite does not exist.
void from_stored(double stored, std::optional<double>& value);
/// Sets `value` from the form of the files.
void from_stored(std::string const& stored, std::string& value);
/// Sets `value` from its name. @throws Hdf5Error when no outcome with a result has this name
void from_stored(std::string const& stored, core::Outcome& value);
/// Sets `value` from its name. @throws Hdf5Error when there is no such verdict
void from_stored(std::string const& stored, measure::Verdict& value);

}  // namespace vibrotrough::store
