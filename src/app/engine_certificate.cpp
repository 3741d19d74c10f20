#include "app/engine_certificate.hpp"

#include "app/standard_streams.hpp"
#include "core/error.hpp"
#include "deck/deck.hpp"
#include "engine/probe.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

/// One line for people: how many probes passed, and which failed.
std::string verdict_of(engine::Certificate const& certificate) {
    if (!certificate.problem.empty()) return certificate.problem;
    std::string text, failed;
    for (engine::ProbeResult const& probe : certificate.probes) {
        if (probe.passed()) continue;
        failed += (failed.empty() ? "" : ", ") + probe.name;
        if (text.empty())
            text = fmt::format(" ({}: measured {:.6g}, expected {:.6g})", probe.name, probe.measured,
                               probe.expected);
    }
    auto const passed = std::ranges::count_if(certificate.probes, &engine::ProbeResult::passed);
    return fmt::format("{} of {} probes passed{}{}", passed, certificate.probes.size(),
                       failed.empty() ? "" : "; failed: " + failed, text);
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
    return true;
}

bool try_meshes(engine::Engine const& engine, std::string const& campaign_file,
                std::vector<scenario::Scenario> const& cases) {
    std::set<std::map<std::string, std::string>> known;
    for (scenario::Scenario const& one : cases) {
        if (!one.trough.mesh) continue;
        deck::Deck const deck = deck::make_deck(prepare::prepare_case(one), {1});
        std::map<std::string, std::string> meshes = deck.settle_files;
        meshes.erase(deck::settle_file);
        if (!known.insert(std::move(meshes)).second) continue;
        auto const problem = engine::read_meshes(engine, deck);
        if (!problem) return false;
        if (problem->empty()) continue;
        throw core::InputError(fmt::format(
            "{}: trough.mesh: {}: the engine refuses the surface: {}; export it with fewer or "
            "stouter triangles ('vibrotrough check' names the worst and its place)",
            campaign_file, one.trough.mesh->names(), problem->substr(0, problem->find(" You will need"))));
    }
    return true;
}

}  // namespace vibrotrough::app
