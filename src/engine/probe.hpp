#pragma once

#include "deck/deck.hpp"
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

/// Lets the engine read the meshes of a deck in a temporary folder, which takes about a second, so that it
/// refuses them before grains are poured in and not in every packing.
/// @return what it says, an empty text when it takes them; none when it was interrupted
/// @throws MissingError when a file cannot be written or the engine cannot be started
std::optional<std::string> read_meshes(Engine const& engine, deck::Deck const& deck);

/// The files of the deck by their names.
std::map<std::string, std::string> probe_deck();

/// SHA-256 of the deck and of the version number of the verdicts.
std::string digest_of_probes();

}  // namespace vibrotrough::engine
