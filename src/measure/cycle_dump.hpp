#pragma once

#include "core/atomic_file.hpp"

#include <array>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

/// @file
/// The grains that the engine found at the end of each cycle where a deck takes them out.

namespace vibrotrough::measure {

/// One grain of a dump.
struct DumpedGrain {
    int cycle;                     ///< at whose end it was found, from 1
    std::array<double, 5> values;  ///< of the columns; those that there are not are 0
};

/// The step at which the run began that wrote NAME.STEPending, such as left.3000.dump; none for other names.
std::optional<long> start_step(std::filesystem::path const& path, std::string_view name,
                               std::string_view ending);

/// Reads NAME.STEP.dump of a packing, one file for each start of the engine. What a later start repeated
/// replaces what the earlier one wrote. An incomplete last snapshot is left out.
/// @param name     "left" or "passed"
/// @param columns  of the dump, five at most, such as "id x vx"
/// @throws InputError naming the file when it is damaged
std::vector<DumpedGrain> parse_cycle_dumps(std::vector<core::TextFile> const& files, std::string_view name,
                                           std::string_view columns, int steps_per_cycle);

}  // namespace vibrotrough::measure
