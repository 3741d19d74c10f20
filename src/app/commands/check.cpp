#include "app/check_report.hpp"
#include "app/commands.hpp"
#include "app/exit_code.hpp"
#include "core/error.hpp"
#include "deck/estimates.hpp"
#include "engine/certificate_cache.hpp"

#include <cmath>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::app {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
    std::string campaign_file;
    std::string engine;
    bool json = false;
};

/// How fast the engine is, and who says so.
struct Speed {
    double grain_steps_per_second;
    std::string source;
};

/// One core, 600 to 5000 grains of Debian's LIGGGHTS 3.8.0: 5 to 6.5 million were measured.
constexpr double usual_speed = 5e6;

Speed engine_speed(std::string const& asked) {
    try {
        engine::Engine const engine =
            engine::find_engine(asked.empty() ? std::nullopt : std::optional<std::filesystem::path>(asked));
        auto const certificate = engine::find_certificate(engine::identify(engine));
        if (certificate && certificate->grain_steps_per_cpu_second > 0)
            return {certificate->grain_steps_per_cpu_second, "the engine's certificate"};
    } catch (core::MissingError const&) {
        if (!asked.empty()) throw;
    }
    return {usual_speed, "the usual engine; 'vibrotrough probe-engine' measures this machine's"};
}

Json number(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json describe(deck::Finding const& finding) {
    return {{"severity", to_string(finding.severity)},
            {"item", finding.item},
            {"key", finding.key},
            {"measured", number(finding.measured)},
            {"unit", finding.unit},
            {"bound", finding.at_least ? "at least" : "at most"},
            {"limit", number(finding.limit)},
            {"hard_limit", number(finding.hard_limit)},
            {"advice", finding.advice}};
}

void print_json(scenario::Campaign const& campaign, CheckReport const& report, Speed const& speed) {
    Json cases = Json::array();
    int index = 0;
    prepare::CasePreparer preparer;
    for (scenario::Scenario const& scenario : campaign.cases) {
        prepare::PreparedCase const prepared = preparer.prepare(scenario);
        Json findings = Json::array();
        for (deck::Finding const& finding : deck::check(prepared)) findings.push_back(describe(finding));
        double const work = deck::expected_work(prepared);
        cases.push_back({{"case", ++index},
                         {"throw_number", prepared.throw_number},
                         {"findings", findings},
                         {"expected_cycles_per_packing", deck::expected_cycles(prepared)},
                         {"expected_grain_steps", work},
                         {"expected_core_hours", work / speed.grain_steps_per_second / 3600}});
    }
    Json const json{{"campaign", campaign.name},
                    {"warnings", report.warnings()},
                    {"errors", report.errors()},
                    {"cases", cases},
                    {"grain_steps_per_cpu_second", speed.grain_steps_per_second},
                    {"speed_source", speed.source},
                    {"expected_bytes", report.bytes},
                    {"expected_core_hours", report.grain_steps / speed.grain_steps_per_second / 3600}};
    fmt::print("{}\n", json.dump(2));
}

void print_text(CheckReport const& report, Speed const& speed) {
    fmt::print("{:<8} {:<56} {:>10}   {}\n", "", "item (the worst of all cases)", "number", "limit");
    for (CheckRow const& row : report.rows) {
        fmt::print("{:<8} {:<56} {:>10.3g}   {} {:.3g}{}\n", to_string(row.worst.severity), row.worst.item,
                   row.worst.measured, row.worst.at_least ? "at least" : "at most ", row.worst.limit,
                   row.worst.unit == "1" ? "" : " " + row.worst.unit);
    }
    for (CheckRow const& row : report.rows) {
        if (row.worst.severity != deck::Severity::fine)
            fmt::print("{}: {}\n", to_string(row.worst.severity), describe(row, report.cases));
    }
    fmt::print(
        "{} cases, {} packings of about {:.0f} cycles (start-up, and what their half_width needs), {:.2g} "
        "MB\n",
        report.cases, report.packings, report.cycles / report.packings, report.bytes / 1e6);
    fmt::print("expected cost: {:.2g} core-hours, at {:.2g} grain-steps per CPU second ({})\n",
               report.grain_steps / speed.grain_steps_per_second / 3600, speed.grain_steps_per_second,
               speed.source);
}

int run(Options const& options) {
    scenario::Campaign const campaign = scenario::read_campaign(options.campaign_file);
    CheckReport const report = check_campaign(campaign);
    Speed const speed = engine_speed(options.engine);
    options.json ? print_json(campaign, report, speed) : print_text(report, speed);
    return report.errors() > 0 ? wrong_input : all_well;
}

}  // namespace

void add_check(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<Options>();
    CLI::App* const command = program.add_subcommand(
        "check", "Look at a campaign before a second is spent on it, and say what it will cost");
    command
        ->add_option("CAMPAIGN.toml", options->campaign_file,
                     "The campaign file (its keys: vibrotrough keys)")
        ->required();
    command
        ->add_option("--liggghts", options->engine,
                     "The LIGGGHTS program whose speed counts; default: liggghts on the PATH, none is needed")
        ->type_name("PATH");
    command->add_flag("--json", options->json, "Print JSON for scripts: all findings of all cases");
    command->footer(
        "Time step against Rayleigh and Hertz time, steps per contact and cycle, overlap at rest and at "
        "impact,\n"
        "contact against flight time, the periodic box, neighbour lists, disk, and the cost in core-hours. "
        "'run'\n"
        "checks too: it shows warnings, and refuses errors unless told --accept-findings.\n"
        "Exit codes: 0 no errors (warnings perhaps); 2 errors were found, or the campaign file is wrong.\n"
        "Example: vibrotrough check validation/demo/campaign.toml");
    command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vibrotrough::app
