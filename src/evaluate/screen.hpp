#pragma once

#include "evaluate/packing_files.hpp"
#include "prepare/prepared_case.hpp"
#include "store/case_record.hpp"

#include <optional>
#include <string>

namespace vibrotrough::evaluate {

/// Measures what passed and what stayed in a packing on a screen.
/// @throws core::InputError when a file is damaged
void measure_screen(store::PackingRecord& record, prepare::PreparedCase const& prepared,
                    PackingFiles const& files);

/// The same of a screen that is fed, in the cycles that count in an open trough.
/// @throws core::InputError when a file is damaged
void measure_fed_screen(store::PackingRecord& record, prepare::PreparedCase const& prepared,
                        PackingFiles const& files);

/// Why the grains that passed a screen and those that are on it are not, size by size, those that were there
/// at first. None when they are, and for other cases. @throws core::InputError when a file is damaged
std::optional<std::string> missing_on_screen(prepare::PreparedCase const& prepared, PackingFiles const& files,
                                             measure::CycleSeries const& series);

}  // namespace vibrotrough::evaluate
