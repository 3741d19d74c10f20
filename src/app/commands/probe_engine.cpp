#include "app/commands.hpp"
#include "app/commands/common_options.hpp"
#include "app/engine_certificate.hpp"
#include "app/exit_code.hpp"
#include "core/atomic_file.hpp"
#include "engine/certificate_cache.hpp"
#include "engine/probe.hpp"

#include <filesystem>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

struct ProbeEngineArguments {
    std::string engine;
    std::string output;
    bool json = false;
};

std::string describe(engine::ProbeResult const& probe) {
    bool const near = probe.comparison == engine::Comparison::near;
    std::string const answer =
        probe.problem.empty() ? fmt::format("{:.6g}", probe.measured) : "no result: " + probe.problem;
    return fmt::format("{:<6}  {:<28} {:>12}   {} {:.6g} {} {:.2g}{}", probe.passed() ? "passed" : "FAILED",
                       probe.name, answer, near ? "expected" : "at most ", probe.expected, near ? "+-" : "+",
                       probe.tolerance, probe.unit == "1" ? "" : " " + probe.unit);
}

void print_text(engine::Certificate const& certificate) {
    fmt::print("{}\n{}\n", certificate.engine.program, certificate.engine.version);
    if (!certificate.engine.library.empty()) fmt::print("links {}\n", certificate.engine.library);
    for (engine::ProbeResult const& probe : certificate.probes) fmt::print("{}\n", describe(probe));
    if (certificate.grain_steps_per_cpu_second > 0) {
        fmt::print("speed: {:.2g} grain-steps per CPU second with {} grains\n",
                   certificate.grain_steps_per_cpu_second, certificate.speed_grains);
    }
}

int run_probe_engine(ProbeEngineArguments const& options) {
    engine::Engine const engine = engine::find_engine(
        options.engine.empty() ? std::nullopt : std::optional<std::filesystem::path>(options.engine));
    auto const certificate = probe_now(engine);
    if (!certificate) return interrupted;
    if (!options.output.empty()) core::write_file_atomically(options.output, engine::to_json(*certificate));
    if (options.json) {
        fmt::print("{}", engine::to_json(*certificate));
    } else {
        print_text(*certificate);
        fmt::print("{}\n", verdict_of(*certificate));
    }
    return certificate->passed() ? all_well : some_cases_failed;
}

}  // namespace

void add_probe_engine(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<ProbeEngineArguments>();
    CLI::App* const command = program.add_subcommand(
        "probe-engine", "Test whether the contacts, friction and drive of a LIGGGHTS binary are correct");
    add_engine(*command, options->engine);
    command->add_option("--output", options->output, "Also write the certificate (JSON) to this file")
        ->type_name("FILE");
    command->add_flag("--json", options->json, "Print the certificate (JSON) instead of the table");
    command->footer(
        R"(Runs small decks for a few seconds, and prints one line per probe with the measured and the expected
value. The probes are: impacts of single grains, compared with the contact law integrated without the engine; Coulomb's
limit and the energy in oblique impacts; sticking, sliding and rolling on an incline; the motion of the trough and its
contacts; and the speed of the engine.

A certificate whose probes all passed is kept in $XDG_CACHE_HOME/vibrotrough (or ~/.cache/vibrotrough), so that
'vibrotrough run' tests each binary only once.

Exit codes:
    0  all probes passed
    1  a probe failed
    3  something is missing: liggghts, or disk space
  130  interrupted

Example:
  vibrotrough probe-engine --liggghts /opt/liggghts/bin/liggghts --output certificate.json)");
    command->callback([options, &exit_code] { exit_code = run_probe_engine(*options); });
}

}  // namespace vibrotrough::app
