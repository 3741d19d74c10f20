#include "engine/certificate_cache.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "engine/probe_decks.hpp"

#include <cstdlib>

#include <boost/process.hpp>

namespace vibrotrough::engine {
namespace {

namespace bp = boost::process;
namespace fs = std::filesystem;

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

std::optional<fs::path> certificate_file(EngineIdentity const& identity) {
    auto const folder = certificate_folder();
    if (!folder) return {};
    return *folder / (identity.key() + ".json");
}

}  // namespace

EngineIdentity identify(Engine const& engine) {
    EngineIdentity identity{};
    identity.program = engine.program.string();
    identity.program_sha256 = core::sha256_hex(core::read_file(engine.program));
    identity.library = linked_library(engine.program);
    if (!identity.library.empty())
        identity.library_sha256 = core::sha256_hex(core::read_file(identity.library));
    identity.version = engine.version;
    identity.probes_sha256 = digest_of_probes();
    return identity;
}

std::optional<fs::path> certificate_folder() {
    // The XDG base directory specification says that a relative XDG_CACHE_HOME must be ignored.
    char const* const cache = std::getenv("XDG_CACHE_HOME");
    if (cache != nullptr && fs::path(cache).is_absolute()) return fs::path(cache) / "vibrotrough" / "engines";
    char const* const home = std::getenv("HOME");
    if (home == nullptr || *home == '\0') return {};
    return fs::path(home) / ".cache" / "vibrotrough" / "engines";
}

std::optional<Certificate> find_certificate(EngineIdentity const& identity) {
    auto const file = certificate_file(identity);
    std::error_code ignored;
    if (!file || !fs::is_regular_file(*file, ignored)) return {};
    try {
        auto certificate = parse_certificate(core::read_file(*file, core::largest_note));
        if (certificate && certificate->passed() && certificate->engine.key() == identity.key())
            return certificate;
    } catch (core::MissingError const&) {
        // treat an unreadable certificate like a missing one
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
