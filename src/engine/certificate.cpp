#include "engine/certificate.hpp"

#include "core/hash.hpp"
#include "core/text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

namespace vibrotrough::engine {
namespace {

using Json = nlohmann::ordered_json;
constexpr char const* format_name = "vibrotrough engine certificate";

Json number(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

double number(Json const& value) {
    return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
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
    return {json.at("name"),
            json.at("question"),
            json.at("source"),
            json.at("unit"),
            json.at("comparison") == "near" ? Comparison::near : Comparison::at_most,
            number(json.at("expected")),
            number(json.at("measured")),
            number(json.at("tolerance")),
            json.at("tolerance_reason"),
            json.at("problem")};
}

Json describe(EngineIdentity const& engine) {
    return {{"program", core::utf8_of_bytes(engine.program)},
            {"program_sha256", engine.program_sha256},
            {"library", core::utf8_of_bytes(engine.library)},
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
    Json json = Json::parse(text, nullptr, false);
    if (!json.is_object()) return {};
    try {
        std::string const digest = json.at("content_sha256");
        json.erase("content_sha256");
        if (json.at("format") != format_name || core::sha256_hex(json.dump()) != digest) return {};
        Json const& engine = json.at("engine");
        Certificate certificate{
            {core::bytes_of_utf8(engine.at("program").get<std::string>()), engine.at("program_sha256"),
             core::bytes_of_utf8(engine.at("library").get<std::string>()), engine.at("library_sha256"),
             engine.at("version"), engine.at("probes_sha256")},
            json.at("program_version"),
            json.at("git_commit"),
            json.at("host"),
            json.at("probed"),
            number(json.at("grain_steps_per_cpu_second")),
            json.at("speed_grains"),
            {}};
        for (Json const& probe : json.at("probes")) certificate.probes.push_back(read_probe(probe));
        return certificate;
    } catch (Json::exception const&) {
        return {};
    }
}

}  // namespace vibrotrough::engine
