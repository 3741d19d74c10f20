#pragma once

#include "measure/mass_flow.hpp"
#include "scenario/reader/keys.hpp"
#include "store/quantity.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// @file
/// The table of everything in the store's files: beside the quantities the facts of a case, its series and
/// its tables. `vibrotrough quantities` prints it, and a test compares it with files that were written.

namespace vibrotrough::store {

/// The description of a dataset or field. Its type follows from its value.
struct Entry {
    std::string_view name;     ///< of the dataset or field
    std::string_view units;    ///< "1" for pure numbers and texts
    std::string_view meaning;  ///< for people; the attribute `description`
};

/// A text that identifies a case or tells where it was made: a root attribute of result.h5, a column of
/// campaign.h5.
struct CaseFact {
    Entry entry;  ///< its description
    /// Its place in the record.
    std::variant<Field<CaseRecord, std::string>, Field<CaseRecord, core::Outcome>> field;
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
/// All series of a packing.
std::vector<PackingSeries> const& packing_series();
/// All columns of the tables of a packing.
std::vector<PackingTable> const& packing_tables();
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
