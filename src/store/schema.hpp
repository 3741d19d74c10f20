#pragma once

#include "store/case_record.hpp"

#include <string>
#include <string_view>
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

/// Texts that say which case this is and where it was made: root attributes of result.h5, columns of
/// campaign.h5.
struct CaseFact {
    Entry entry;
    std::string& (*field)(CaseRecord&);
};

/// One number of a case: `case/<name>` of result.h5, a column of campaign.h5.
struct CaseValue {
    Entry entry;
    std::variant<int (*)(CaseRecord const&), double (*)(CaseRecord const&),
                 std::string (*)(CaseRecord const&)>
        value;
};

/// One value per packing: `packings/<name>` of result.h5.
struct PackingValue {
    Entry entry;
    std::variant<int*, double*, std::string*, measure::Verdict*> (*field)(PackingRecord&);
};

enum class SeriesLength {
    cycles,      ///< one value per cycle 1 ... n
    cycle_ends,  ///< one value per end of cycle 0 ... n
};

/// One series of a packing: `series/<packing>/<name>` of result.h5, packings counted from 1.
struct PackingSeries {
    Entry entry;
    SeriesLength length;
    std::vector<double>& (*field)(PackingRecord&);
};

/// One column of a table of a packing: `<group>/<packing>/<name>` of result.h5. All columns of a group have
/// the same length.
struct PackingTable {
    std::string_view group;
    Entry entry;
    std::vector<double>& (*field)(PackingRecord&);
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

}  // namespace vibrotrough::store
