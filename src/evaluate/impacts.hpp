#pragma once

#include "evaluate/packing_files.hpp"
#include "prepare/prepared_case.hpp"
#include "store/case_record.hpp"

#include <filesystem>
#include <optional>
#include <string>

/// @file
/// The engine writes all contacts of the watched cycles. The impacts among them are a hundred times fewer, so
/// that they take the place of these files when the run of a packing has ended.

namespace vibrotrough::evaluate {

/// The name of the file with the impacts.
inline constexpr char const* impacts_file = "impacts.csv";

/// The impacts in the contacts that the engine wrote, as text of `impacts_file`; none when measure.impacts
/// does not ask for them, or when the files of a cycle are missing or incomplete.
/// @throws core::InputError when they are damaged
std::optional<std::string> find_impacts(prepare::PreparedCase const& prepared,
                                        std::filesystem::path const& folder);

/// Replaces the files with the contacts by `impacts_file`.
/// @throws core::InputError when they are damaged, core::MissingError when the disk refuses
void keep_impacts(prepare::PreparedCase const& prepared, std::filesystem::path const& folder);

/// Measures the impacts. Does nothing when measure.impacts does not ask for it.
/// @throws core::InputError when they are missing or damaged
void measure_impacts(store::PackingRecord& record, prepare::PreparedCase const& prepared,
                     PackingFiles const& files);

}  // namespace vibrotrough::evaluate
