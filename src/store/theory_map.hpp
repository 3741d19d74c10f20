#pragma once

#include "theory/map.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace vibrotrough::store {

/// Writes a map of the point-mass theory as HDF5, atomically. The reference of the manual has its schema.
/// @param fixed  inputs that are the same at all points
/// @throws core::MissingError when it cannot be written
void write_theory_map(std::filesystem::path const& path, theory::Map const& map, theory::Inputs const& fixed);

/// One column of a table of points. It holds numbers or texts. All columns of a table have the same length.
struct TheoryColumn {
    std::string name;                ///< of the dataset
    std::string units;               ///< in the spelling of udunits2; "1" for pure numbers and texts
    std::string description;         ///< meaning of the column
    std::vector<double> numbers;     ///< values of a column of numbers
    std::vector<std::string> texts;  ///< values of a column of texts, which has no numbers
};

/// Writes points of the theory as HDF5, one dataset per column, atomically.
/// @throws core::MissingError when it cannot be written
void write_theory_table(std::filesystem::path const& path, std::vector<TheoryColumn> const& columns);

/// The unit of an input in the spelling of udunits2.
std::string units_of(theory::Input input);

}  // namespace vibrotrough::store
