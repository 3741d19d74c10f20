#pragma once

#include "engine/certificate.hpp"
#include "engine/engine.hpp"

#include <optional>
#include <string>

namespace vibrotrough::app {

/// Probes the engine, tells the user so on standard error and keeps the certificate for next time. Nothing
/// when interrupted.
std::optional<engine::Certificate> probe_now(engine::Engine const& engine);

/// The kept certificate of this binary, else `probe_now`.
std::optional<engine::Certificate> certificate_of(engine::Engine const& engine);

/// Gives the engine its certificate. An engine whose probes failed is refused unless the user accepts that.
/// False when interrupted.
/// @throws MissingError when it is refused
bool certify(engine::Engine& engine, bool accept_failed_probes);

/// One line: how many probes passed, and which failed.
std::string verdict_of(engine::Certificate const& certificate);

}  // namespace vibrotrough::app
