#pragma once

#include "engine/certificate.hpp"
#include "engine/engine.hpp"

#include <optional>

namespace vibrotrough::engine {

/// Runs the small decks of `probe_decks` at the same time in a temporary folder and compares the results with
/// the values of `probe_verdicts`. If all probes pass, it then measures the speed of the engine. Takes a few
/// seconds. If the engine fails on a deck, all probes of that deck fail. SIGINT and SIGTERM end the engines,
/// and std::nullopt is returned.
/// @throws MissingError when a file cannot be written or the engine cannot be started
std::optional<Certificate> probe_engine(Engine const& engine, EngineIdentity const& identity);

}  // namespace vibrotrough::engine
