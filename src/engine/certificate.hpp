#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::engine {

/// What makes one engine binary this one.
struct EngineIdentity {
    std::string program;         ///< path
    std::string program_sha256;  ///< of the file
    std::string library;         ///< path of the libliggghts that the program links; empty when it links none
    std::string library_sha256;  ///< empty when there is none
    std::string version;         ///< as it names itself
    std::string probes_sha256;   ///< of the probes' decks: other probes need another certificate

    /// SHA-256 over all but the paths: the certificate's name.
    std::string key() const;
};

/// How a measured value is compared with the expected one.
enum class Comparison {
    near,     ///< |measured - expected| <= tolerance
    at_most,  ///< measured <= expected + tolerance
};

/// One question to the engine, and its answer.
struct ProbeResult {
    std::string name;              ///< e.g. "restitution-0.5"
    std::string question;          ///< one sentence
    std::string source;            ///< formula or reference of `expected`
    std::string unit;              ///< "1" for pure numbers
    Comparison comparison;         ///< how `measured` is judged
    double expected;               ///< by the source
    double measured;               ///< NaN when the engine gave no answer; `problem` says why
    double tolerance;              ///< largest difference that passes
    std::string tolerance_reason;  ///< why the tolerance is as large as it is
    std::string problem;           ///< why there is no answer; empty when there is one

    /// The measured value is within the tolerance.
    bool passed() const;
};

/// What the probes found out about one engine binary.
struct Certificate {
    EngineIdentity engine;                          ///< the binary that was probed
    std::string program_version, git_commit, host;  ///< that probed
    std::string probed;                             ///< ISO 8601, UTC
    double grain_steps_per_cpu_second = 0;          ///< of a packed layer; 0 when a probe failed
    int speed_grains = 0;                           ///< number of grains in that layer
    std::vector<ProbeResult> probes;                ///< in the order in which they are reported

    bool passed() const;  ///< all probes passed, and there are some
};

/// The certificate as JSON text, with the SHA-256 of its own content as the last member.
std::string to_json(Certificate const& certificate);

/// Nothing when the text is no certificate, is damaged or was changed by hand.
std::optional<Certificate> parse_certificate(std::string_view json);

}  // namespace vibrotrough::engine
