#include "app/commands/command.hpp"
#include "core/text.hpp"
#include "evaluate/by_hand.hpp"
#include "measure/estimate.hpp"

#include <numeric>
#include <span>

namespace vibrotrough::app {
namespace {

struct MeasureArguments {
    std::string folder;
    std::string scenario;
    bool json = false;
};

std::optional<double> theory(evaluate::HandRun const& run) {
    theory::Motion const motion = solve(run.prepared.point_mass);
    return motion.converged ? std::optional(motion.velocity_efficiency) : std::nullopt;
}

/// The mean of one run and the interval that follows from its own cycles, which says nothing of how packings
/// differ.
measure::PackingEstimate by_itself(evaluate::HandPacking const& packing,
                                   scenario::MeasurementPlan const& plan, int used) {
    std::span const all(packing.efficiency);
    return measure::estimate_packing(all.first(static_cast<std::size_t>(used)),
                                     {plan.confidence, plan.half_width});
}

/// The bound of the numerical errors; none for a rigid block, or a contact that somebody wrote into the deck,
/// of which no bound is known.
std::optional<double> numerical_error(evaluate::HandRun const& run) {
    bool const is_block = run.prepared.scenario.layer.block != scenario::Block::none;
    if (is_block || !run.has_known_contact) return {};
    return run.prepared.numerics.total();
}

/// The statistics and the numerics of an interval in words.
std::string parts_of_interval(evaluate::HandRun const& run) {
    auto const numerics = numerical_error(run);
    if (!numerics) return "statistics alone";
    return fmt::format("statistics {:.4f}, numerics below {:.4f}", *run.estimate.half_width, *numerics);
}

/// Of the velocity efficiency, for statistics and numerics together.
std::optional<double> whole_half_width(evaluate::HandRun const& run) {
    if (!run.estimate.half_width || !numerical_error(run)) return run.estimate.half_width;
    return prepare::whole_half_width(*run.estimate.half_width, run.prepared.numerics);
}

Json describe(evaluate::HandPacking const& packing, scenario::MeasurementPlan const& plan, int used) {
    auto const first = packing.efficiency.begin();
    double const mean = std::accumulate(first, first + used, 0.0) / used;
    measure::PackingEstimate const own = by_itself(packing, plan, used);
    return {{"packing", packing.number},
            {"folder", packing.folder.string()},
            {"cycles", packing.cycles},
            {"mean_of_all_cycles_used", mean},
            {"own_efficiency", own.mean},
            {"own_half_width", std::isfinite(own.half_width) ? Json(own.half_width) : Json(nullptr)},
            {"mode", packing.mode.empty() ? Json(nullptr) : Json(packing.mode)},
            {"end", packing.end},
            {"fault", packing.fault ? Json(name_of(*packing.fault)) : Json(nullptr)},
            {"message", packing.message}};
}

void print_json(evaluate::HandRun const& run) {
    double const scale = run.prepared.velocity_scale;
    measure::CaseEstimate const& e = run.estimate;
    auto const speed = [&](std::optional<double> const& value) {
        return value ? Json(*value * scale) : Json(nullptr);
    };
    Json packings = Json::array();
    for (evaluate::HandPacking const& one : run.packings)
        packings.push_back(describe(one, run.prepared.scenario.measure, run.cycles_used));
    std::string const open = not_covered(run.prepared.scenario.engine);
    Json const json{{"outcome", name_of(run.outcome)},
                    {"efficiency", number_or_null(e.mean)},
                    {"efficiency_half_width_statistics", number_or_null(e.half_width)},
                    {"efficiency_numerics", number_or_null(numerical_error(run))},
                    {"efficiency_half_width", number_or_null(whole_half_width(run))},
                    {"confidence", run.prepared.scenario.measure.confidence},
                    {"speed_m_per_s", speed(e.mean)},
                    {"speed_half_width_m_per_s", speed(whole_half_width(run))},
                    {"efficiency_theory", number_or_null(theory(run))},
                    {"cycles_used", run.cycles_used},
                    {"cycles_discarded", e.discarded},
                    {"cycles_measured", e.measured},
                    {"not_covered", open.empty() ? Json(nullptr) : Json(open)},
                    {"scenario", run.scenario_file.string()},
                    {"changes", run.changes},
                    {"packings", packings}};
    fmt::print("{}\n", json.dump(2, ' ', true, Json::error_handler_t::replace));
}

void print_packing(evaluate::HandPacking const& packing, scenario::MeasurementPlan const& plan, int used) {
    fmt::print("{}: {} cycles{}\n", packing.folder.string(), packing.cycles,
               packing.mode.empty() ? "" : ", mode " + packing.mode);
    measure::PackingEstimate const own = by_itself(packing, plan, used);
    if (std::isfinite(own.half_width)) {
        fmt::print(
            "  velocity efficiency: {:.4f} +- {:.4f} ({:g} %, from the scatter of its own cycles only)\n",
            own.mean, own.half_width, 100 * plan.confidence);
    } else {
        fmt::print("  velocity efficiency: {:.4f}, from too few cycles for an interval\n", own.mean);
    }
    fmt::print("  end of the run: {}\n", core::harmless(packing.end));
    if (packing.fault)
        fmt::print("  a campaign would not count it: {}, {}\n", name_of(*packing.fault),
                   core::harmless(packing.message));
}

void print_text(evaluate::HandRun const& run) {
    measure::CaseEstimate const& e = run.estimate;
    scenario::MeasurementPlan const& plan = run.prepared.scenario.measure;
    for (evaluate::HandPacking const& one : run.packings) print_packing(one, plan, run.cycles_used);
    fmt::print("scenario: {}\n", run.scenario_file.string());
    for (std::string const& change : run.changes) fmt::print("edited: {}\n", change);
    if (std::string const open = not_covered(run.prepared.scenario.engine); !open.empty())
        fmt::print("not covered by the engine's certificate: {}\n", open);
    std::string const interval =
        !e.mean ? "unknown"
        : e.half_width
            ? fmt::format("{:.4f} +- {:.4f} ({:g} %: {})", *e.mean, *whole_half_width(run),
                          100 * plan.confidence, parts_of_interval(run))
            : fmt::format(
                  "{:.4f}, with an unbounded interval because one packing does not tell how packings differ",
                  *e.mean);
    fmt::print("velocity efficiency: {}, from {} packing{} of {} cycles, {} of them cut as start-up\n",
               interval, run.packings.size(), run.packings.size() == 1 ? "" : "s", run.cycles_used,
               e.discarded);
    if (e.mean) fmt::print("conveying speed: {:.4g} m/s\n", *e.mean * run.prepared.velocity_scale);
    if (auto const predicted = theory(run)) fmt::print("point-mass theory: {:.4f}\n", *predicted);
    fmt::print("outcome: {}\n", name_of(run.outcome));
}

int run_measure(MeasureArguments const& options) {
    evaluate::HandRun const run = evaluate::measure_by_hand(options.folder, options.scenario);
    options.json ? print_json(run) : print_text(run);
    return run.outcome == core::Outcome::finished ? all_well : some_cases_failed;
}

}  // namespace

void add_measure(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<MeasureArguments>();
    CLI::App* const command =
        program.add_subcommand("measure", "Measure a run of LIGGGHTS that was made by hand from a deck");
    command
        ->add_option("FOLDER", options->folder,
                     "Folder in which the engine ran (packing-1), or that of a case with several of them")
        ->required()
        ->type_name("FOLDER");
    add_text(*command, "--scenario", options->scenario,
             "The scenario.toml that says what was simulated; default: the one in the folder or above it",
             "FILE");
    command->add_flag("--json", options->json, "Print JSON for scripts");
    command->footer(
        R"(Prints the velocity efficiency with its interval as 'run' and 'compare' would find it, and the outcome.
Nothing is written. The deck may have been changed after 'vibrotrough deck' wrote it: what is measured is what the engine
wrote, divided by the amplitude, angle and frequency with which its trough moved. A run that was stopped, or still goes on, is measured as far as it is.

The interval is that of the campaign: with several packings it allows for their differences, with one it cannot.

Example:
  vibrotrough measure decks/case-001/packing-1

The folder of that example comes from
  vibrotrough deck validation/demo/campaign.toml --output decks
  cd decks/case-001/packing-1 && liggghts -in settle.liggghts && liggghts -in in.liggghts)");
    command->callback([options, &exit_code] { exit_code = run_measure(*options); });
}

}  // namespace vibrotrough::app
