#include "engine/certificate.hpp"

#include "core/hash.hpp"
#include "core/note.hpp"
#include "core/text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

namespace vibrotrough::engine {
namespace {

namespace note = core::note;
using note::Json;
constexpr char const* format_name = "vibrotrough engine certificate";

Json number(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

double known_or_nan(Json const& json, std::string const& key,
                    double least = std::numeric_limits<double>::lowest()) {
    return note::known_number(json, key, least).value_or(std::numeric_limits<double>::quiet_NaN());
}

Json describe(ProbeResult const& probe) {
    return {{"name", probe.name},
            {"question", probe.question},
            {"expected", number(probe.expected)},
            {"comparison", probe.comparison == Comparison::near ? "near" : "at most"},
            {"source", probe.source},
            {"measured", number(probe.measured)},
            {"unit", probe.unit},
            {"tolerance", number(probe.tolerance)},
            {"tolerance_reason", probe.tolerance_reason},
            {"problem", probe.problem},
            {"verdict", probe.passed() ? "passed" : "failed"}};
}

ProbeResult read_probe(Json const& json) {
    return {note::text(json, "name"),
            note::text(json, "question"),
            note::text(json, "source"),
            note::text(json, "unit"),
            note::text(json, "comparison") == "near" ? Comparison::near : Comparison::at_most,
            known_or_nan(json, "expected"),
            known_or_nan(json, "measured"),
            known_or_nan(json, "tolerance"),
            note::text(json, "tolerance_reason"),
            note::text(json, "problem")};
}

Json describe(EngineIdentity const& engine) {
    return {{"program", core::harmless(engine.program)},
            {"program_sha256", engine.program_sha256},
            {"library", core::harmless(engine.library)},
            {"library_sha256", engine.library_sha256},
            {"version", engine.version},
            {"probes_sha256", engine.probes_sha256}};
}

Json describe(Certificate const& certificate) {
    Json probes = Json::array();
    for (ProbeResult const& probe : certificate.probes) probes.push_back(describe(probe));
    return {{"format", format_name},
            {"verdict", certificate.passed() ? "passed" : "failed"},
            {"engine", describe(certificate.engine)},
            {"program_version", certificate.program_version},
            {"git_commit", certificate.git_commit},
            {"host", certificate.host},
            {"probed", certificate.probed},
            {"grain_steps_per_cpu_second", number(certificate.grain_steps_per_cpu_second)},
            {"speed_grains", certificate.speed_grains},
            {"probes", probes}};
}

}  // namespace

std::string EngineIdentity::key() const {
    return core::sha256_hex(program_sha256 + "\n" + library_sha256 + "\n" + version + "\n" + probes_sha256);
}

std::string EngineIdentity::binary_sha256() const {
    return core::sha256_hex(program_sha256 + "\n" + library_sha256);
}

bool ProbeResult::passed() const {
    double const excess = measured - expected;  // comparisons with NaN are false
    return problem.empty() && (comparison == Comparison::near ? std::abs(excess) : excess) <= tolerance;
}

bool Certificate::passed() const {
    return !probes.empty() && std::ranges::all_of(probes, &ProbeResult::passed);
}

std::string to_json(Certificate const& certificate) {
    Json json = describe(certificate);
    json["content_sha256"] = core::sha256_hex(json.dump());
    return json.dump(2) + "\n";
}

std::optional<Certificate> parse_certificate(std::string_view text) {
    try {
        Json json = note::parse(text);
        std::string const digest = note::text(json, "content_sha256");
        json.erase("content_sha256");
        if (note::text(json, "format") != format_name || core::sha256_hex(json.dump()) != digest) return {};
        Json const& engine = note::object(json, "engine");
        Certificate certificate{{note::text(engine, "program"), note::text(engine, "program_sha256"),
                                 note::text(engine, "library"), note::text(engine, "library_sha256"),
                                 note::text(engine, "version"), note::text(engine, "probes_sha256")},
                                note::text(json, "program_version"),
                                note::text(json, "git_commit"),
                                note::text(json, "host"),
                                note::text(json, "probed"),
                                known_or_nan(json, "grain_steps_per_cpu_second", 0),
                                note::count(json, "speed_grains", 0),
                                {}};
        for (Json const& probe : note::list(json, "probes")) certificate.probes.push_back(read_probe(probe));
        return certificate;
    } catch (note::Fault const&) {
        return {};
    }
}

}  // namespace vibrotrough::engine
