#pragma once

#include "theory/map.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace vibrotrough::store {

/// Writes a map of the point-mass theory as HDF5, atomically; the schema is in README.md.
/// @throws MissingError when the disk refuses
void write_theory_map(std::filesystem::path const& path, theory::Map const& map, theory::Inputs const& fixed);

/// One column of a table of points: numbers or texts, all columns of one length.
struct TheoryColumn {
    std::string name, units, description;
    std::vector<double> numbers;
    std::vector<std::string> texts;  ///< used when there are no numbers
};

/// Writes points of the theory as HDF5, one dataset per column, atomically. @throws MissingError when the
/// disk refuses
void write_theory_table(std::filesystem::path const& path, std::vector<TheoryColumn> const& columns);

/// The unit of an input in udunits2's spelling.
std::string units_of(theory::Input input);

}  // namespace vibrotrough::store
