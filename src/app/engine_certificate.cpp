#include "app/engine_certificate.hpp"

#include "app/standard_streams.hpp"
#include "core/error.hpp"
#include "engine/binary_watch.hpp"
#include "engine/certificate_cache.hpp"
#include "engine/probe.hpp"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

std::optional<engine::Certificate> probe(engine::Engine const& engine,
                                         engine::EngineIdentity const& identity) {
    tell("probing {} (once per binary, a few seconds)\n", engine.program.string());
    auto const start = std::chrono::steady_clock::now();
    auto const certificate = engine::probe_engine(engine, identity);
    if (!certificate) return {};
    std::chrono::duration<double> const spent = std::chrono::steady_clock::now() - start;
    tell("{} ({:.1f} s)\n", verdict_of(*certificate), spent.count());
    if (!certificate->passed()) return certificate;
    if (std::string const problem = engine::keep_certificate(*certificate); !problem.empty()) {
        tell("the certificate is not kept, the next run probes again: {}\n", problem);
    }
    return certificate;
}

std::optional<engine::Certificate> kept_or_new(engine::Engine const& engine,
                                               engine::EngineIdentity const& identity) {
    if (auto const kept = engine::find_certificate(identity)) return kept;
    return probe(engine, identity);
}

}  // namespace

std::optional<engine::Certificate> probe_now(engine::Engine const& engine) {
    return probe(engine, engine::identify(engine));
}

std::optional<engine::Certificate> certificate_of(engine::Engine const& engine) {
    return kept_or_new(engine, engine::identify(engine));
}

std::string verdict_of(engine::Certificate const& certificate) {
    auto const& probes = certificate.probes;
    auto const passed = std::ranges::count_if(probes, &engine::ProbeResult::passed);
    std::string text = fmt::format("{} of {} probes passed", passed, probes.size());
    if (certificate.passed()) return text;
    auto const& worst = *std::ranges::find_if_not(probes, &engine::ProbeResult::passed);
    std::string names;
    for (engine::ProbeResult const& probe : probes) {
        if (!probe.passed()) names += (names.empty() ? "" : ", ") + probe.name;
    }
    text += fmt::format("; failed: {} ({}: ", names, worst.name);
    if (!worst.problem.empty()) return text + worst.problem + ")";
    return text + fmt::format("measured {:.6g}, {} {:.6g})", worst.measured,
                              worst.comparison == engine::Comparison::near ? "expected" : "at most",
                              worst.expected);
}

bool certify(engine::Engine& engine, bool accept_failed_probes) {
    engine::EngineIdentity const identity = engine::identify(engine);
    auto const certificate = kept_or_new(engine, identity);
    if (!certificate) return false;
    if (!certificate->passed() && !accept_failed_probes) {
        throw core::MissingError(fmt::format(
            "{} failed its probes: {}; give another engine with --liggghts PATH, see all probes with "
            "'vibrotrough probe-engine', or run it anyway with --accept-failed-probes",
            engine.program.string(), verdict_of(*certificate)));
    }
    engine.certificate = engine::to_json(*certificate);
    engine.binary_sha256 = identity.binary_sha256();
    engine.watch = std::make_shared<engine::BinaryWatch const>(identity);
    return true;
}

}  // namespace vibrotrough::app
