#pragma once

#include "engine/engine.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::engine {

/// The identity of an engine binary.
struct EngineIdentity {
    std::string program;         ///< path
    std::string program_sha256;  ///< of the program's file
    std::string library;  ///< path of the libliggghts that the program links; empty if it does not link one
    std::string library_sha256;  ///< empty if `library` is empty
    std::string version;         ///< as the engine reports it
    /// Of the probes: after a change of them a new certificate is needed.
    std::string probes_sha256;

    /// SHA-256 over all members except the paths; it is the name of the certificate.
    std::string key() const;
};

/// Reads the engine's files and determines the identity of the binary. Notes the digest of the binary, and
/// what its files are like, in `engine`.
/// @throws MissingError when the program cannot be read
EngineIdentity identify(Engine& engine);

/// A pure number that was measured, and what it should be.
struct ProbeResult {
    std::string name;      ///< e.g. "restitution-0.5"
    std::string question;  ///< one sentence
    double expected;       ///< by the contact law
    double measured;       ///< of the engine
    double tolerance;      ///< largest difference that passes

    /// The measured value is within the tolerance.
    bool passed() const;
};

/// The results of all probes for one engine binary.
struct Certificate {
    EngineIdentity engine;            ///< the binary that was probed
    std::string probed;               ///< ISO 8601, UTC
    std::vector<ProbeResult> probes;  ///< in the order in which they are reported
    std::string problem = {};         ///< why there are none; empty when there are

    bool passed() const;  ///< whether there are probes and all of them passed
};

/// The certificate as JSON text, with the version of this program and the machine.
std::string to_json(Certificate const& certificate);

/// The folder in which certificates are kept: $XDG_CACHE_HOME/vibrotrough/engines or
/// ~/.cache/vibrotrough/engines; std::nullopt if neither XDG_CACHE_HOME nor HOME is set.
std::optional<std::filesystem::path> certificate_folder();

/// The text of the certificate that was kept of this binary; std::nullopt if there is none or if it is
/// damaged.
std::optional<std::string> find_certificate(EngineIdentity const& identity);

/// Stores the certificate for later use if all probes passed. Returns why it could not be stored, or an empty
/// text.
std::string keep_certificate(Certificate const& certificate);

}  // namespace vibrotrough::engine
