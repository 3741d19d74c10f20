#pragma once

#include "engine/certificate.hpp"
#include "engine/engine.hpp"

#include <optional>
#include <string>

namespace vibrotrough::app {

/// Probes the engine, which takes a few seconds, prints that and the result on standard error, and keeps the
/// certificate of an engine that passed. None when interrupted.
std::optional<engine::Certificate> probe_now(engine::Engine const& engine);

/// The certificate of this binary that was kept, else that of probe_now().
std::optional<engine::Certificate> certificate_of(engine::Engine const& engine);

/// Stores its certificate in `engine`, and from now on watches that its binary stays the same. False when
/// interrupted.
/// @param accept_failed_probes  whether the user accepts an engine whose probes failed
/// @throws core::MissingError when probes failed and the user does not accept that
bool certify(engine::Engine& engine, bool accept_failed_probes);

/// One line for people: how many probes passed, and which failed.
std::string verdict_of(engine::Certificate const& certificate);

}  // namespace vibrotrough::app
