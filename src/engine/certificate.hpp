#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::engine {

/// The identity of an engine binary.
struct EngineIdentity {
    std::string program;         ///< path
    std::string program_sha256;  ///< of the program's file
    std::string library;  ///< path of the libliggghts that the program links; empty if it does not link one
    std::string library_sha256;  ///< empty if `library` is empty
    std::string version;         ///< as the engine reports it
    /// Of the probe decks: after a change of the probes a new certificate is needed.
    std::string probes_sha256;

    /// SHA-256 over all members except the paths; it is the name of the certificate.
    std::string key() const;
    /// SHA-256 over the digests of the two files: of the binary alone.
    std::string binary_sha256() const;
};

/// How a measured value is compared with the expected one.
enum class Comparison {
    near,     ///< |measured - expected| <= tolerance
    at_most,  ///< measured <= expected + tolerance
};

/// One question to the engine, with the expected and the measured value.
struct ProbeResult {
    std::string name;              ///< e.g. "restitution-0.5"
    std::string question;          ///< one sentence
    std::string source;            ///< formula or reference of `expected`
    std::string unit;              ///< "1" for pure numbers
    Comparison comparison;         ///< how `measured` is judged
    double expected;               ///< by the source
    double measured;               ///< NaN if the probe could not be evaluated; `problem` says why
    double tolerance;              ///< largest difference that passes
    std::string tolerance_reason;  ///< why the tolerance is as large as it is
    std::string problem;           ///< why there is no answer; empty when there is one

    /// The measured value is within the tolerance.
    bool passed() const;
};

/// The results of all probes for one engine binary.
struct Certificate {
    EngineIdentity engine;                          ///< the binary that was probed
    std::string program_version, git_commit, host;  ///< of the program that ran the probes, and its machine
    std::string probed;                             ///< ISO 8601, UTC
    double grain_steps_per_cpu_second = 0;          ///< for a packed layer; 0 if a probe failed
    int speed_grains = 0;                           ///< number of grains in that layer
    std::vector<ProbeResult> probes;                ///< in the order in which they are reported

    bool passed() const;  ///< whether there are probes and all of them passed
};

/// The certificate as JSON text. Its last member is the SHA-256 of the rest of its content.
std::string to_json(Certificate const& certificate);

/// Reads a certificate. Returns std::nullopt if the text is not a certificate, is damaged or was changed by
/// hand.
std::optional<Certificate> parse_certificate(std::string_view json);

}  // namespace vibrotrough::engine
