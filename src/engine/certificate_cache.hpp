#pragma once

#include "engine/certificate.hpp"
#include "engine/engine.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace vibrotrough::engine {

/// Reads the engine's files and tells which binary it is.
/// @throws MissingError when the program cannot be read
EngineIdentity identify(Engine const& engine);

/// Where certificates are kept: $XDG_CACHE_HOME/vibrotrough/engines or ~/.cache/vibrotrough/engines; nothing
/// when neither variable is set.
std::optional<std::filesystem::path> certificate_folder();

/// The kept certificate of this binary; nothing when there is none or it is damaged.
std::optional<Certificate> find_certificate(EngineIdentity const& identity);

/// Keeps the certificate for next time, if it passed. Returns why it could not be kept, or an empty text.
std::string keep_certificate(Certificate const& certificate);

}  // namespace vibrotrough::engine
