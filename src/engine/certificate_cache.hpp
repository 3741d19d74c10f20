#pragma once

#include "engine/certificate.hpp"
#include "engine/engine.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace vibrotrough::engine {

/// Reads the engine's files and determines the identity of the binary.
/// @throws MissingError when the program cannot be read
EngineIdentity identify(Engine const& engine);

/// The folder in which certificates are kept: $XDG_CACHE_HOME/vibrotrough/engines or
/// ~/.cache/vibrotrough/engines; std::nullopt if neither XDG_CACHE_HOME nor HOME is set.
std::optional<std::filesystem::path> certificate_folder();

/// The stored certificate of this binary; std::nullopt if there is none or if it is damaged.
std::optional<Certificate> find_certificate(EngineIdentity const& identity);

/// Stores the certificate for later use if all probes passed. Returns why it could not be stored, or an empty
/// text.
std::string keep_certificate(Certificate const& certificate);

}  // namespace vibrotrough::engine
