#pragma once

#include "campaign/state/overview.hpp"

#include <filesystem>
#include <vector>

#include <nlohmann/json.hpp>

namespace vibrotrough::compare {

/// Writes what a figure of a record and its cycle needs, for each different motion that troughs of these
/// cases take from a record; motions of stages are left out.
///
/// In `folder/records`, numbered from 1, in the unit of the record, m or m/s2:
/// - `<n>.csv`: the first 20,000 samples, and how many cycles of the fundamental they are behind the first
/// one;
///   where they were used also the mean and drift that were left out, and the motion of the deck;
/// - `<n>_cycle.csv`: one cycle of the motion of the deck.
///
/// @returns for each its file, unit, remarks, number of samples, and the cases that it drives
nlohmann::ordered_json write_records(std::vector<campaign::CaseOverview> const& cases,
                                     std::filesystem::path const& folder);

}  // namespace vibrotrough::compare
