#pragma once

#include "engine/engine.hpp"
#include "scenario/model/scenario.hpp"

#include <string>
#include <vector>

namespace vibrotrough::app {

/// Stores the certificate of its binary in `engine`: the one that was kept, else that of the probes, whose
/// result is printed on standard error. From now on the binary is watched, that it stays the same. False when
/// interrupted.
/// @param accept_failed_probes  whether the user accepts an engine whose probes failed
/// @throws core::MissingError when probes failed and the user does not accept that
bool certify(engine::Engine& engine, bool accept_failed_probes);

/// Lets the engine read each mesh of the cases once. False when interrupted.
/// @throws core::InputError with what the engine says when it refuses one
bool try_meshes(engine::Engine const& engine, std::string const& campaign_file,
                std::vector<scenario::Scenario> const& cases);

}  // namespace vibrotrough::app
