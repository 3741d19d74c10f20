#pragma once

#include "measure/stage_means.hpp"
#include "scenario/reader/keys.hpp"
#include "store/quantity.hpp"

#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// @file
/// The table of everything in the store's files: beside the quantities the facts of a case, and the tables of
/// a case and of its packings. Files are written and read by it, and `vibrotrough quantities` prints it.

namespace vibrotrough::store {

/// The description of a dataset or of a column of a table. Its type follows from its value.
struct Entry {
    std::string name;     ///< of the dataset or column
    std::string units;    ///< "1" for pure numbers and texts
    std::string meaning;  ///< for people; the attribute `description`
};

/// A text that identifies a case or tells where it was made: a root attribute of result.h5, a column of
/// campaign.h5.
struct CaseFact {
    Entry entry;  ///< its description
    /// Its place in the record.
    std::variant<Field<CaseRecord, std::string>, Field<CaseRecord, core::Outcome>> field;
};

/// All facts of a case, in the order of the files.
std::vector<CaseFact> const& case_facts();

/// What the theory says of a case: a column of campaign.h5, which is not in result.h5.
struct CaseTheoryColumn {
    Entry entry;  ///< its description
    /// Its place in the record.
    std::variant<Field<CaseRecord, std::string>, Field<CaseRecord, std::optional<double>>> field;
};

/// What campaign.h5 has of the theory, in the order of the file.
std::vector<CaseTheoryColumn> const& case_theory_columns();

/// A column of a table of a packing.
struct PackingColumn {
    Entry entry;                                      ///< its description
    Field<PackingRecord, std::vector<double>> field;  ///< its place in the record
};

/// A table of each packing: `<name>/<packing>` of result.h5, packings counted from 1. A column that is empty
/// while others have rows, such as that of a material that the case does not have, is not in the file.
struct PackingTable {
    std::string_view name;                     ///< of the group
    std::string_view rows;                     ///< what there is a row of
    bool (*is_of)(scenario::Scenario const&);  ///< whether a case has it
    std::vector<PackingColumn> columns;        ///< in the order of the file
};

/// All tables of a packing.
std::vector<PackingTable> const& packing_tables();

/// The values of a column of a table of the case.
using CaseValues = std::variant<std::vector<double>, std::vector<std::string>>;

/// A table of a case that follows from its packings: it is written and not read.
struct CaseTable {
    std::string_view name;       ///< of the dataset
    std::string_view rows;       ///< what there is a row of
    std::vector<Entry> columns;  ///< their descriptions
    /// The values of its first columns; none when the case does not have the table.
    std::vector<CaseValues> (*values)(CaseRecord const&);
    std::string_view text = "";  ///< the column that holds texts
};

/// All of them.
std::vector<CaseTable> const& case_tables();

/// The table of the case with this name.
CaseTable const& case_table(std::string_view name);

/// Adds the description of a number that is a mean over the packings, and that of its half-width.
void add_measured(std::vector<Entry>& entries, Entry const& entry);

/// Mean and half-width over the packings of a number that each row of a table has.
class MeasuredColumn {
  public:
    /// A column without rows, whose intervals have this level.
    explicit MeasuredColumn(double confidence) : confidence_(confidence) {}

    /// The next row: the number of each packing.
    void add(measure::EnsembleNumber const& value) {
        means.push_back(value.mean());
        half_widths.push_back(value.half_width(confidence_));
    }
    /// Adds the means, and behind them the half-widths, to the columns of a table.
    void put_into(std::vector<CaseValues>& columns) const {
        columns.emplace_back(means);
        columns.emplace_back(half_widths);
    }

    std::vector<double> means = {};        ///< over the packings, row by row
    std::vector<double> half_widths = {};  ///< of their intervals; NaN with one packing

  private:
    double confidence_;
};

/// Mean and half-width of each row of a column, over the packings that have a number there.
MeasuredColumn over_packings(CaseRecord const& record,
                             Field<PackingRecord, std::vector<double>> const& column, std::size_t rows);

/// The frozen scenario, a text of result.h5.
inline Entry const scenario_entry{"scenario", "1",
                                  "The scenario as a campaign file of one case (TOML, SI units)"};
inline Entry const certificate_entry{"engine_certificate", "1",
                                     "Certificate of the engine binary (JSON): what its probes showed; empty "
                                     "when it was not probed"};  ///< the same
inline Entry const scenario_files_entry{
    "scenario_files", "1",
    "The files that the scenario names: a JSON object of names and contents"};  ///< its files

/// The values of a swept key, a dataset `swept/<key>` of campaign.h5. Angles are in rad.
Entry swept_entry(scenario::Key const& key);

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
