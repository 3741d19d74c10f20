#pragma once

#include "engine/certificate.hpp"
#include "engine/engine.hpp"

#include <map>
#include <optional>
#include <string>

namespace vibrotrough::engine {

/// Lets single grains hit a floor in a temporary folder, which takes less than a second, and compares what is
/// left of their velocities with the contact law of the decks (contact_law.hpp): restitution, and Coulomb's
/// friction. If the engine fails on the deck, all probes fail. SIGINT and SIGTERM end the engine, and
/// std::nullopt is returned.
/// @throws MissingError when a file cannot be written or the engine cannot be started
std::optional<Certificate> probe_engine(Engine const& engine, EngineIdentity const& identity);

/// The files of the deck by their names.
std::map<std::string, std::string> probe_deck();

/// SHA-256 of the deck and of the version number of the verdicts.
std::string digest_of_probes();

}  // namespace vibrotrough::engine
