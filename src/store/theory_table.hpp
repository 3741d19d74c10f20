#pragma once

#include "core/atomic_file.hpp"
#include "theory/batch.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace vibrotrough::store {

/// Points for the theory as a CSV file gives them.
struct TheoryPoints {
    std::vector<theory::Input> columns;           ///< in the order of the file
    std::vector<std::vector<std::string>> cells;  ///< of each point as written, but with decimal points
    std::vector<theory::Inputs> points;
};

/// Reads a CSV file whose columns are inputs of the theory (throw_number, friction, ...) and whose rows are
/// points. An empty cell is an input that this point does not have. Lines that begin with # are skipped.
/// @throws InputError "file:line: problem; what to write" when the file or a point is not complete
TheoryPoints read_theory_points(std::filesystem::path const& path);

/// The same of a text that is already there.
TheoryPoints parse_theory_points(core::TextFile const& file);

/// The points as they were written and the theory's answers beside them, as CSV: velocity_efficiency,
/// half_width, mode, period_cycles, converged.
std::string theory_answers_csv(TheoryPoints const& table, std::vector<theory::MapPoint> const& answers);

/// The same as HDF5, one dataset per column. An input that a point does not have is NaN.
/// @throws MissingError when the disk refuses
void write_theory_answers(std::filesystem::path const& path, TheoryPoints const& table,
                          std::vector<theory::MapPoint> const& answers);

}  // namespace vibrotrough::store
