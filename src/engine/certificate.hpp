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
    /// SHA-256 over the digests of the two files: of the binary alone.
    std::string binary_sha256() const;
};

/// Reads the engine's files and determines the identity of the binary.
/// @throws MissingError when the program cannot be read
EngineIdentity identify(Engine const& engine);

/// How a measured value is compared with the expected one.
enum class Comparison {
    near,     ///< |measured - expected| <= tolerance
    at_most,  ///< measured <= expected + tolerance
};

/// One question to the engine, with the expected and the measured value, both pure numbers.
struct ProbeResult {
    std::string name;              ///< e.g. "restitution-0.5"
    std::string question;          ///< one sentence
    std::string source;            ///< formula or reference of `expected`
    Comparison comparison;         ///< how `measured` is judged
    double expected;               ///< by the source
    double tolerance;              ///< largest difference that passes
    std::string tolerance_reason;  ///< why the tolerance is as large as it is
    double measured = 0;           ///< no number if `problem` says why there is none
    std::string problem = {};      ///< why there is no answer; empty when there is one

    /// The measured value is within the tolerance.
    bool passed() const;
};

/// The results of all probes for one engine binary.
struct Certificate {
    EngineIdentity engine;            ///< the binary that was probed
    std::string probed;               ///< ISO 8601, UTC
    std::vector<ProbeResult> probes;  ///< in the order in which they are reported

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
