#include "engine/certificate.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/note.hpp"
#include "core/text.hpp"
#include "core/time.hpp"
#include "core/version.hpp"
#include "engine/probe.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <boost/process.hpp>
#include <nlohmann/json.hpp>

namespace vibrotrough::engine {
namespace {

namespace bp = boost::process;
namespace fs = std::filesystem;
namespace note = core::note;
using note::Json;

/// The libliggghts that the dynamic linker would load for the program; empty for a script or a program that
/// does not link one.
std::string linked_library(fs::path const& program) {
    auto const ldd = bp::search_path("ldd");
    if (ldd.empty()) return {};
    try {
        bp::ipstream output;
        bp::child child(ldd, bp::args({program.string()}), bp::std_out > output, bp::std_err > bp::null,
                        bp::std_in < bp::null);
        std::string library;
        for (std::string line; std::getline(output, line);) {
            auto const arrow = line.find(" => /");
            auto const end = line.rfind(" (");
            if (line.find("libliggghts") >= arrow || arrow == std::string::npos) continue;
            library = line.substr(arrow + 4, end == std::string::npos ? end : end - arrow - 4);
        }
        child.wait();
        return library;
    } catch (bp::process_error const&) {
        return {};
    }
}

char const* verdict(bool passed) {
    return passed ? "passed" : "failed";
}

std::optional<fs::path> certificate_file(EngineIdentity const& identity) {
    auto const folder = certificate_folder();
    if (!folder) return {};
    return *folder / (identity.key() + ".json");
}

Json describe(ProbeResult const& probe) {
    return {{"name", probe.name},           {"question", probe.question},
            {"expected", probe.expected},   {"measured", probe.measured},
            {"tolerance", probe.tolerance}, {"verdict", verdict(probe.passed())}};
}

}  // namespace

std::string EngineIdentity::key() const {
    return core::sha256_hex(program_sha256 + "\n" + library_sha256 + "\n" + version + "\n" + probes_sha256);
}

EngineIdentity identify(Engine& engine) {
    EngineIdentity identity{};
    auto const digest_of = [&](fs::path const& path) {
        engine.files.push_back(stamp_of(path));  // before it is read
        return core::sha256_hex(core::read_file(path));
    };
    engine.files.clear();
    identity.program = engine.program.string();
    identity.program_sha256 = digest_of(engine.program);
    identity.library = linked_library(engine.program);
    if (!identity.library.empty()) identity.library_sha256 = digest_of(identity.library);
    identity.version = engine.version;
    identity.probes_sha256 = digest_of_probes();
    engine.binary_sha256 = core::sha256_hex(identity.program_sha256 + "\n" + identity.library_sha256);
    return identity;
}

bool ProbeResult::passed() const {
    return std::abs(measured - expected) <= tolerance;  // comparisons with NaN are false
}

bool Certificate::passed() const {
    return !probes.empty() && std::ranges::all_of(probes, &ProbeResult::passed);
}

std::string to_json(Certificate const& certificate) {
    Json probes = Json::array();
    for (ProbeResult const& probe : certificate.probes) probes.push_back(describe(probe));
    EngineIdentity const& engine = certificate.engine;
    Json const json{{"format", "vibrotrough engine certificate"},
                    {"verdict", verdict(certificate.passed())},
                    {"engine",
                     {{"program", core::harmless(engine.program)},
                      {"program_sha256", engine.program_sha256},
                      {"library", core::harmless(engine.library)},
                      {"library_sha256", engine.library_sha256},
                      {"version", engine.version},
                      {"probes_sha256", engine.probes_sha256},
                      {"key", engine.key()}}},
                    {"program_version", core::program_version()},
                    {"git_commit", core::program_commit()},
                    {"host", core::host_name()},
                    {"probed", certificate.probed},
                    {"probes", probes},
                    {"problem", certificate.problem}};
    return json.dump(2) + "\n";
}

std::optional<fs::path> certificate_folder() {
    // The XDG base directory specification says that a relative XDG_CACHE_HOME must be ignored.
    char const* const cache = std::getenv("XDG_CACHE_HOME");
    if (cache != nullptr && fs::path(cache).is_absolute()) return fs::path(cache) / "vibrotrough" / "engines";
    char const* const home = std::getenv("HOME");
    if (home == nullptr || *home == '\0') return {};
    return fs::path(home) / ".cache" / "vibrotrough" / "engines";
}

std::optional<std::string> find_certificate(EngineIdentity const& identity) {
    auto const file = certificate_file(identity);
    std::error_code ignored;
    if (!file || !fs::is_regular_file(*file, ignored)) return {};
    try {
        std::string const text = core::read_file(*file, core::largest_note);
        Json const json = note::parse(text);
        if (note::text(json, "verdict") == "passed" &&
            note::text(note::object(json, "engine"), "key") == identity.key())
            return text;
    } catch (core::Error const&) {
        // An unreadable or damaged one counts as none.
    }
    return {};
}

std::string keep_certificate(Certificate const& certificate) {
    if (!certificate.passed()) return "not all probes passed";
    auto const file = certificate_file(certificate.engine);
    if (!file) return "neither XDG_CACHE_HOME nor HOME is set";
    try {
        core::make_folder(file->parent_path());
        core::write_file_atomically(*file, to_json(certificate));
        return {};
    } catch (core::Error const& error) {
        return error.what();
    }
}

}  // namespace vibrotrough::engine
