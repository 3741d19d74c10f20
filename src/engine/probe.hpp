#pragma once

#include "engine/certificate.hpp"
#include "engine/engine.hpp"

#include <optional>

namespace vibrotrough::engine {

/// Asks the engine the questions of `probe_verdicts` by running small decks in a temporary folder, all at a
/// time, and then, if it passed, measures its speed, alone. Takes a few seconds. An engine that breaks on a
/// deck fails that deck's probes. SIGINT and SIGTERM end the engines: nothing is returned.
/// @throws MissingError when the disk refuses or the engine cannot be started
std::optional<Certificate> probe_engine(Engine const& engine, EngineIdentity const& identity);

}  // namespace vibrotrough::engine
