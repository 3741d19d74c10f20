#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::learn {

/// A conveying speed that was measured, and the setting of the machine. A quantity that the table does not
/// give is empty; then it is either the same for all measurements and given elsewhere, or free.
struct MeasuredSpeed {
    int line;                               ///< of the table, from 1
    double amplitude;                       ///< m, in the direction of vibration, half the stroke, > 0
    double frequency;                       ///< Hz, > 0
    std::optional<double> vibration_angle;  ///< rad, within (0, pi/2)
    std::optional<double> inclination;      ///< rad, within (-pi/2, pi/2), uphill positive
    double speed;                           ///< m/s, along the trough, positive in the conveying direction
    double uncertainty;      ///< m/s, standard uncertainty (one standard deviation) of `speed`, > 0
    bool is_stroke = false;  ///< the table has the stroke, not the amplitude
    bool is_turns = false;   ///< the table has turns per minute, not a frequency
};

/// Reads a table of measured speeds (see core::CsvReader for the format; ';', tabs and decimal commas are
/// welcome).
///
/// The columns are found by their names and may stand in any order:
/// - stroke_mm, or amplitude_mm (half the stroke)
/// - rpm (revolutions per minute, one cycle each), or frequency_hz
/// - vibration_angle_deg and inclination_deg; either may be missing
/// - speed_m_per_s, or speed_m_per_min
/// - uncertainty_m_per_s, or uncertainty_m_per_min: the standard uncertainty (one standard deviation). The
/// column or single cells may be
///   missing when `relative_uncertainty` says what stands for them.
///
/// @param path                  names the table in errors
/// @param relative_uncertainty  uncertainty over speed where the table gives none, > 0
/// @throws core::CsvError (with line and column) when the table cannot be read, a column is missing, unknown
/// or given in two forms, a number is out of range, or there is no measurement
std::vector<MeasuredSpeed> read_speeds(std::string_view text, std::string const& path,
                                       std::optional<double> relative_uncertainty = {});

/// A sentence for each kind of number that is unusual in a table of measured speeds, with the line where it
/// stands first and the slip that would explain it: m/min for m/s, Hz for rpm, radians for degrees.
std::vector<std::string> unusual_speeds(std::vector<MeasuredSpeed> const& speeds);

}  // namespace vibrotrough::learn
