#include "app/engine_certificate.hpp"

#include "app/standard_streams.hpp"
#include "core/error.hpp"
#include "engine/binary_watch.hpp"
#include "engine/probe.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

/// One line for people: how many probes passed, and which failed.
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

}  // namespace

bool certify(engine::Engine& engine, bool accept_failed_probes) {
    engine::EngineIdentity const identity = engine::identify(engine);
    if (auto kept = engine::find_certificate(identity)) {
        engine.certificate = *kept;
    } else {
        tell("probing {} (once per binary, a few seconds)\n", engine.program.string());
        auto const certificate = engine::probe_engine(engine, identity);
        if (!certificate) return false;
        std::string const verdict = verdict_of(*certificate);
        tell("{}\n", verdict);
        if (!certificate->passed() && !accept_failed_probes) {
            throw core::MissingError(fmt::format(
                "{} failed its probes: {}; give another engine with --liggghts PATH, or run it anyway with "
                "--accept-failed-probes",
                engine.program.string(), verdict));
        }
        std::string const problem = certificate->passed() ? engine::keep_certificate(*certificate) : "";
        if (!problem.empty()) tell("the certificate is not kept, the next run probes again: {}\n", problem);
        engine.certificate = engine::to_json(*certificate);
    }
    engine.binary_sha256 = identity.binary_sha256();
    engine.watch = std::make_shared<engine::BinaryWatch const>(identity);
    return true;
}

}  // namespace vibrotrough::app
