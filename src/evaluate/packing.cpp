#include "evaluate/packing.hpp"

#include "core/csv.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "deck/deck.hpp"
#include "evaluate/layer.hpp"
#include "evaluate/open_trough.hpp"
#include "evaluate/screen.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include <fmt/format.h>

namespace vibrotrough::evaluate {
namespace {

namespace fs = std::filesystem;

/// The balance of momentum over whole cycles is exact up to the integrator; 1e-5 was seen.
constexpr double balance_tolerance = 0.002;

/// Displacements and velocities differ by at most 2.1e-4 of omega r in any cycle of 631 packings of spheres:
/// the mean of the velocity over the steps is off by half a step at both ends. So many times omega r is ten
/// times that, and a tenth of the usual half-width.
constexpr double speed_tolerance = 0.002;

/// A layer faster than so many times the trough has blown up.
constexpr double largest_speed_ratio = 100;

/// The mean velocity in each cycle over the omega r cos(beta) of [trough]: the cycles of stages differ in
/// their durations.
std::vector<double> efficiency_in_stages(prepare::PreparedCase const& prepared,
                                         measure::CycleSeries const& series) {
    std::vector<double> const durations = cycle_durations(prepared.stages);
    if (prepared.clump || prepared.domain.open)
        return measure::velocity_efficiency_by_mean(series, prepared.velocity_scale);
    std::vector<double> efficiency;
    for (std::size_t i = 0; i + 1 < series.x.size() && i < durations.size(); ++i)
        efficiency.push_back((series.x[i + 1] - series.x[i]) / (durations[i] * prepared.velocity_scale));
    return efficiency;
}

std::vector<double> efficiency_of(prepare::PreparedCase const& prepared, measure::CycleSeries const& series) {
    scenario::Scenario const& s = prepared.scenario;
    if (!prepared.stages.empty()) return efficiency_in_stages(prepared, series);
    // The engine does not unwrap the positions of rigid bodies, and the grains of an open trough and on a
    // screen come and go.
    if (prepared.clump || prepared.domain.loses_grains())
        return measure::velocity_efficiency_by_mean(series, prepared.velocity_scale);
    return measure::velocity_efficiency(series, length_scale(s.trough));
}

measure::Precision wanted(prepare::PreparedCase const& prepared) {
    return {prepared.scenario.measure.confidence, prepared.scenario.measure.half_width};
}

/// The durations of so many cycles, s.
std::vector<double> durations_of(prepare::PreparedCase const& prepared, int cycles) {
    if (!prepared.stages.empty()) return cycle_durations(prepared.stages);
    return std::vector<double>(static_cast<std::size_t>(cycles), 1 / prepared.scenario.trough.frequency);
}

/// m/s
double tolerance_of(prepare::PreparedCase const& prepared) {
    return speed_tolerance * prepared.angular_frequency * prepared.scenario.trough.amplitude;
}

measure::CycleSeries parse(prepare::PreparedCase const& prepared, core::TextFile const& cycles) {
    if (prepared.domain.loses_grains())
        return measure::parse_open_cycles(
            cycles, prepared.time.steps_per_cycle,
            is_fed_screen(prepared.scenario) ? static_cast<int>(prepared.classes.size()) : 0);
    auto series = measure::parse_cycles(cycles, prepared.time.steps_per_cycle, prepared.scenario.layer.grains,
                                        static_cast<int>(prepared.materials.size()));
    // The velocities of single materials are not known.
    if (prepared.clump || prepared.materials.size() > 1) return series;
    auto const durations = durations_of(prepared, series.cycles());
    return measure::without_jumps(std::move(series), prepared.scenario.layer.length, durations,
                                  tolerance_of(prepared));
}

measure::CycleSeries first_of(measure::CycleSeries const& series, int cycles, fs::path const& folder) {
    if (series.cycles() < cycles) {
        throw core::InputError(fmt::format("{} holds {} cycles and should hold {}",
                                           (folder / "cycles.csv").string(), series.cycles(), cycles));
    }
    return measure::first_cycles(series, cycles);
}

/// Measures a packing from its cycles and the phases within them.
/// @throws core::InputError when its snapshots are damaged, or phases and cycles do not belong together
store::PackingRecord measure_packing(prepare::PreparedCase const& prepared, int packing,
                                     PackingFiles const& files, measure::CycleSeries const& series,
                                     measure::PhaseSeries const& phases) {
    store::PackingRecord record{};
    record.seed = deck::packing_seed(packing);
    record.steps_per_cycle = prepared.time.steps_per_cycle;
    record.time_step = prepared.time.time_step;
    record.mass = prepared.mass;
    record.series = series;
    record.efficiency = efficiency_of(prepared, record.series);
    record.estimate = measure::estimate_packing(record.efficiency, wanted(prepared));
    if (prepared.domain.open) {
        measure_open(record, prepared, files);
        if (prepared.domain.screen) measure_fed_screen(record, prepared, files);
    } else if (prepared.domain.screen) {
        measure_screen(record, prepared, files);
    } else {
        measure_layer(record, prepared, files, phases);
    }
    return record;
}

/// N, forces on the trough in the first and in the last hundredth of a cycle together. The balance of
/// momentum may be off by this force during a hundredth of a cycle: the forces are sums over steps, while the
/// velocities at both ends belong to one instant, which for a single grain may lie within an impact.
double force_at_the_ends(measure::PhaseSeries const& phases) {
    if (phases.lines() == 0) return 0;
    return std::abs(phases.normal_force.front()) + std::abs(phases.normal_force.back());
}

/// What is said when displacements and velocities contradict each other. Positions of rigid bodies are not
/// unwrapped, and grains of an open trough and of a screen come and go.
std::optional<UnusableOutputs> find_contradiction(prepare::PreparedCase const& prepared,
                                                  measure::CycleSeries const& cycles) {
    if (prepared.clump || prepared.domain.loses_grains()) return {};
    double const trough = prepared.angular_frequency * prepared.scenario.trough.amplitude;
    double const difference = measure::difference_of_speeds(cycles, durations_of(prepared, cycles.cycles()));
    if (difference <= tolerance_of(prepared)) return {};
    return UnusableOutputs{
        core::Outcome::outputs_incomplete,
        fmt::format("cycles.csv contradicts itself: in a cycle the displacement of the layer (x_com) and its "
                    "mean velocity (mean_vx) differ by {:.3g} m/s; the trough moves with {:.3g} m/s{}",
                    difference, trough,
                    prepared.materials.size() > 1 ? ". LIGGGHTS follows a mixture for 512 lengths of the "
                                                    "periodic box: lengthen it, or lower measure.max_cycles"
                                                  : "")};
}

std::optional<UnusableOutputs> find_fault(prepare::PreparedCase const& prepared, PackingFiles const& files,
                                          measure::CycleSeries const& cycles,
                                          measure::PhaseSeries const& phases, long last_step) {
    constexpr auto incomplete = core::Outcome::outputs_incomplete;
    if (!measure::is_finite(cycles))
        return UnusableOutputs{core::Outcome::diverged, "cycles.csv holds a number that is NaN or infinite"};
    if (static_cast<long>(cycles.cycles()) * prepared.time.steps_per_cycle != last_step) {
        return UnusableOutputs{incomplete,
                               fmt::format("cycles.csv holds {} cycles, the engine ended at step {}",
                                           cycles.cycles(), last_step)};
    }
    if (prepared.domain.loses_grains()) {
        auto missing = measure::imbalance(cycles);
        if (!missing) missing = missing_on_screen(prepared, files, cycles);
        return missing ? std::optional(UnusableOutputs{core::Outcome::lost_grains, *missing}) : std::nullopt;
    }
    if (phases.cycles() != cycles.cycles()) {
        return UnusableOutputs{incomplete, fmt::format("phases.csv holds {} cycles, cycles.csv {}",
                                                       phases.cycles(), cycles.cycles())};
    }
    double const carried =
        prepared.stages.empty()
            ? measure::weight_by_momentum(cycles, prepared.mass, 1 / prepared.scenario.trough.frequency)
            : measure::weight_by_momentum(cycles, prepared.mass, cycle_durations(prepared.stages));
    if (std::abs(carried - prepared.weight) <=
        balance_tolerance * prepared.weight +
            force_at_the_ends(phases) / std::max(1.0, static_cast<double>(phases.lines())))
        return {};
    return UnusableOutputs{
        core::Outcome::wrong_weight,
        fmt::format(
            "the mean force of the layer on the trough over the cycles, less its gain of momentum, is "
            "{:.4g} N; the layer weighs {:.4g} N",
            carried, prepared.weight)};
}

/// The deck that a packing was run with: the one in its folder or, when that is not what was run any more,
/// the same one made again. None when it cannot be made again either.
std::optional<std::string> deck_of_run(prepare::PreparedCase const& prepared, int packing,
                                       fs::path const& packing_folder, PackingMarker const& marker) {
    std::error_code missing;
    fs::path const file = packing_folder / deck::drive_file;
    std::string written;
    if (marker.deck_sha256.empty() || fs::exists(file, missing))
        written = core::read_file(file, core::largest_note);
    if (marker.deck_sha256.empty() || core::sha256_hex(written) == marker.deck_sha256) return written;
    auto const again = deck::make_deck(prepared, {packing, 0, marker.start_efficiency}).files;
    for (int const ranks : {1, 2}) {  // all decks for several ranks are the same
        std::string made = deck::for_ranks(again, ranks).at(deck::drive_file);
        if (core::sha256_hex(made) == marker.deck_sha256) return made;
    }
    return {};
}

}  // namespace

InterimEstimate estimate_so_far(prepare::PreparedCase const& prepared, fs::path const& packing_folder) {
    auto const series = parse(prepared, measure::cycles_text(packing_folder / "cycles.csv"));
    InterimEstimate interim{series.cycles(), {}};
    if (interim.cycles >= 2)
        interim.estimate = measure::estimate_packing(efficiency_of(prepared, series), wanted(prepared));
    return interim;
}

std::optional<FinishedCycles> read_finished_cycles(prepare::PreparedCase const& prepared,
                                                   fs::path const& packing_folder) {
    if (!has_marker(packing_folder)) return {};
    try {
        PackingFiles const files = read_packing_files(packing_folder);
        auto const marker = read_marker(files);
        if (!marker) return {};
        return FinishedCycles{efficiency_of(prepared, parse(prepared, files.cycles)), marker->core_time};
    } catch (core::Error const&) {
        return {};  // damaged: the packing is as good as not run
    }
}

std::vector<double> read_efficiency(prepare::PreparedCase const& prepared, fs::path const& packing_folder,
                                    int cycles) {
    auto const series = parse(prepared, measure::cycles_text(packing_folder / "cycles.csv"));
    return efficiency_of(prepared, first_of(series, cycles, packing_folder));
}

void add_run(store::PackingRecord& record, PackingMarker const& marker) {
    record.wall_time = marker.wall_time;
    record.core_time = marker.core_time;
    record.start_efficiency = marker.start_efficiency;
}

std::variant<store::PackingRecord, UnusableOutputs> evaluate_outputs(prepare::PreparedCase const& prepared,
                                                                     int packing, PackingFiles const& files,
                                                                     long last_step) {
    try {
        auto const cycles = parse(prepared, files.cycles);
        auto const phases = packing_phases(prepared, files.phases);
        if (auto fault = find_fault(prepared, files, cycles, phases, last_step)) return std::move(*fault);
        if (auto fault = find_contradiction(prepared, cycles)) return std::move(*fault);
        return measure_packing(prepared, packing, files, cycles, phases);
    } catch (core::Error const& error) {
        return UnusableOutputs{core::Outcome::outputs_incomplete, error.what()};
    }
}

std::optional<EvaluatedPacking> read_packing(prepare::PreparedCase const& prepared, int packing,
                                             fs::path const& packing_folder, int cycles) {
    if (!has_marker(packing_folder)) return {};
    PackingFiles const files = read_packing_files(packing_folder);
    auto const marker = read_marker(files);
    if (!marker) return {};
    auto deck = deck_of_run(prepared, packing, packing_folder, *marker);
    if (!deck) return {};
    auto const phases = packing_phases(prepared, files.phases);
    auto const series = first_of(parse(prepared, files.cycles), cycles, packing_folder);
    EvaluatedPacking evaluated{*marker, measure_packing(prepared, packing, files, series, phases)};
    add_run(evaluated.record, *marker);
    evaluated.record.deck = std::move(*deck);
    return evaluated;
}

RunExtent extent_of_run(prepare::PreparedCase const& prepared, fs::path const& packing_folder) {
    RunExtent extent;
    double const largest_speed =
        largest_speed_ratio *
        std::max(prepared.angular_frequency * prepared.scenario.trough.amplitude, prepared.largest_speed);
    int lines = 0;
    try {
        std::string const text = measure::cycles_text(packing_folder / "cycles.csv").content;
        core::CsvReader table(
            text, "cycles.csv",
            {.comments = true, .blanks = true, .growing = true, .numbers = core::CsvNumbers::any});
        std::vector<double> row(table.columns().size());
        for (; table.next(row); ++lines) {
            for (std::size_t column = 0; column < row.size(); ++column) {
                std::string_view const name = table.columns()[column];
                bool const is_speed = name == "vz_com" || name == "mean_vx";
                bool const is_sane =
                    std::isfinite(row[column]) && (!is_speed || std::abs(row[column]) <= largest_speed);
                extent.diverged = extent.diverged || !is_sane;
            }
        }
    } catch (core::Error const&) {
        // The file is missing or damaged: what was read so far counts.
    }
    extent.cycles = std::max(0, lines - 1);  // the first line is the start
    return extent;
}

}  // namespace vibrotrough::evaluate
