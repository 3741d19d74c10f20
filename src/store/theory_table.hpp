#pragma once

#include "core/atomic_file.hpp"
#include "theory/batch.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace vibrotrough::store {

/// Points for the theory from a CSV file.
struct TheoryPoints {
    std::vector<theory::Input> columns;           ///< in the order of the file
    std::vector<std::string> names;               ///< of the columns as written, e.g. rpm for frequency_hz
    std::vector<std::vector<std::string>> cells;  ///< of each point as written, but with decimal points
    std::vector<theory::Inputs> points;           ///< the same as numbers
};

/// Reads a CSV file whose columns are inputs of the theory (throw_number, friction, ...) and whose rows are
/// points. The frequency may also be in a column rpm, and the amplitude in one amplitude_mm. An empty cell is
/// an input that this point does not have. Lines that begin with # are skipped.
/// @throws core::InputError "file:line: problem; what to write" when the file or a point is not complete
TheoryPoints read_theory_points(std::filesystem::path const& path);

/// Reads the content of such a file. @throws core::InputError as read_theory_points()
TheoryPoints parse_theory_points(core::TextFile const& file);

/// The motions to which different starts of each point lead.
using Motions = std::vector<std::vector<theory::CoexistingMotion>>;

/// The points as they were written, with the answers of the theory beside them, as CSV: velocity_efficiency,
/// half_width, mode, period_cycles, converged, and conveying_speed_m_per_s when a point has an amplitude.
/// @param motions  of each point, from a MotionSurvey; empty when there was none. Then motions (their
/// number), and efficiency_1, fraction_1 and period_cycles_1, efficiency_2 and so on follow.
std::string theory_answers_csv(TheoryPoints const& table, std::vector<theory::Efficiency> const& answers,
                               Motions const& motions = {});

/// Writes the same table as HDF5, one dataset per column. An input that a point does not have is NaN.
/// @throws core::MissingError when it cannot be written
void write_theory_answers(std::filesystem::path const& path, TheoryPoints const& table,
                          std::vector<theory::Efficiency> const& answers, Motions const& motions = {});

}  // namespace vibrotrough::store
