#pragma once

#include "engine/certificate.hpp"

#include <filesystem>
#include <string>
#include <vector>

/// Compares the engine's results for the decks of `probe_decks` with the expected values.
namespace vibrotrough::engine {

/// Each function reads what the engine wrote into the folder of the deck. If `problem` is not empty, the
/// engine failed on the deck: nothing is read, and all probes of the deck fail with this problem.
std::vector<ProbeResult> judge_fine_impacts(std::filesystem::path const& folder, std::string const& problem);
/// See judge_fine_impacts().
std::vector<ProbeResult> judge_coarse_impacts(std::filesystem::path const& folder,
                                              std::string const& problem);
/// See judge_fine_impacts().
std::vector<ProbeResult> judge_incline(std::filesystem::path const& folder, std::string const& problem);
/// See judge_fine_impacts().
std::vector<ProbeResult> judge_contact(std::filesystem::path const& folder, std::string const& problem);
/// See judge_fine_impacts().
std::vector<ProbeResult> judge_drive(std::filesystem::path const& folder, std::string const& problem);

}  // namespace vibrotrough::engine
