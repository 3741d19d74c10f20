#pragma once

#include "engine/certificate.hpp"

#include <filesystem>
#include <string>
#include <vector>

/// What the engine should have answered to the decks of `probe_decks`, and what it did.
namespace vibrotrough::engine {

/// Each reads what the engine wrote into the deck's folder. When `problem` is not empty the engine did not
/// come through the deck: all the deck's probes then fail with it, and nothing is read.
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
