#include "evaluate/by_hand.hpp"

#include "core/atomic_file.hpp"
#include "core/csv.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "deck/deck.hpp"
#include "evaluate/case.hpp"
#include "evaluate/layer.hpp"
#include "evaluate/packing.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <regex>

#include <fmt/format.h>

namespace vibrotrough::evaluate {
namespace {

namespace fs = std::filesystem;

bool is_file(fs::path const& path) {
    std::error_code missing;
    return fs::is_regular_file(path, missing);
}

/// N of a folder packing-N; 0 when it has another name.
int number_of(fs::path const& folder) {
    std::string const name = folder.filename().string();
    constexpr std::string_view begin = "packing-";
    char const* const end = name.data() + name.size();
    int number = 0;
    // "packing-1-old" is a copy that somebody put aside.
    if (!name.starts_with(begin) || std::from_chars(name.data() + begin.size(), end, number).ptr != end)
        return 0;
    return number >= 1 && number <= 1000 ? number : 0;
}

/// The folders with a run: the folder itself, or its packings in order.
std::vector<fs::path> folders_with_runs(fs::path const& folder) {
    std::error_code failure;
    if (!fs::is_directory(folder, failure))
        throw core::InputError(
            fmt::format("{} is not a folder; give the folder in which the engine ran", folder.string()));
    if (is_file(folder / "cycles.csv")) return {fs::canonical(folder)};
    std::map<int, fs::path> found;
    for (fs::directory_entry const& entry : fs::directory_iterator(folder, failure)) {
        if (number_of(entry.path()) > 0 && is_file(entry.path() / "cycles.csv"))
            found[number_of(entry.path())] = fs::canonical(entry.path());
    }
    std::vector<fs::path> folders;
    for (auto const& [number, path] : found) folders.push_back(path);
    if (!folders.empty()) return folders;
    throw core::InputError(fmt::format(
        "{} has no cycles.csv, nor has a folder packing-1 in it; run the deck first, there: liggghts "
        "-in {} && liggghts -in {}",
        folder.string(), deck::settle_file, deck::drive_file));
}

fs::path find_scenario(fs::path const& given, fs::path const& run) {
    if (!given.empty()) return given;
    for (fs::path const& place : {run, run.parent_path()}) {
        if (is_file(place / "scenario.toml")) return place / "scenario.toml";
    }
    throw core::InputError(fmt::format(
        "there is no scenario.toml in {} or above it, which says what was simulated; give the one "
        "that 'vibrotrough deck' wrote with --scenario FILE",
        run.string()));
}

prepare::PreparedCase read_case(fs::path const& file) {
    scenario::Campaign const campaign = scenario::read_campaign(file);
    if (campaign.cases.size() != 1)
        throw core::InputError(fmt::format("{} holds {} cases; give the scenario.toml of one case",
                                           file.string(), campaign.cases.size()));
    return prepare::prepare_case(campaign.cases.front());
}

/// The whole number N of a line "variable n equal N" of a deck; none when there is no such line.
std::optional<int> steps_per_cycle(fs::path const& deck) {
    if (!is_file(deck)) return {};
    static std::regex const line(R"((^|\n)\s*variable\s+n\s+equal\s+(\d{1,9})\s*(#[^\n]*)?\n)");
    std::string const text = core::read_file(deck, core::largest_note);
    std::smatch found;
    if (!std::regex_search(text, found, line)) return {};
    int const steps = std::stoi(found[2].str());
    return steps >= 1 ? std::optional(steps) : std::nullopt;
}

/// The number X of a line "timestep X" of a deck; none when there is no such line.
std::optional<double> time_step(std::string const& deck) {
    static std::regex const line(R"((^|\n)\s*timestep\s+([0-9.eE+-]+))");
    std::smatch found;
    if (!std::regex_search(deck, found, line)) return {};
    return core::csv_number(found[2].str(), ',', core::CsvNumbers::finite);
}

/// The line of a deck with its contact of grains.
std::string contact_line(std::string const& deck) {
    static std::regex const line(R"((^|\n)\s*pair_style\s+([^\n#]*))");
    std::smatch found;
    return std::regex_search(deck, found, line) ? found[2].str() : "";
}

/// Amplitude of the first harmonic of a displacement with a value for each phase, m.
double first_harmonic(std::vector<double> const& values) {
    constexpr int lines = measure::PhaseSeries::per_cycle;
    std::size_t const count = values.size() / lines * lines;
    std::complex<double> sum = 0;
    for (std::size_t i = 0; i < count; ++i)
        sum += values[i] * std::polar(1.0, 2 * std::numbers::pi * static_cast<double>(i) / lines);
    return 2 * std::abs(sum) / static_cast<double>(std::max<std::size_t>(1, count));
}

/// Amplitude of the fundamental of a Fourier series, m.
double fundamental_of(std::vector<scenario::DriveTerm> const& terms) {
    auto const found = std::ranges::find(terms, 1, &scenario::DriveTerm::order);
    return found == terms.end() ? 0 : std::abs(found->amplitude);
}

/// The drive that was run: of a deck that was edited it differs from the scenario's.
void take_drive(HandRun& run, fs::path const& folder) {
    constexpr double as_asked = 1e-3;  // the same drive, but for 15 digits and whole steps per cycle
    scenario::Scenario scenario = run.prepared.scenario;
    if (!scenario.stages.empty() || !is_file(folder / deck::drive_file)) return;
    std::string const text = core::read_file(folder / deck::drive_file, core::largest_note);
    deck::Deck const as_written = deck::make_deck(run.prepared, {1});
    if (contact_line(text) != contact_line(as_written.files.at(deck::drive_file))) {
        run.has_known_contact = false;
        run.changes.push_back(
            fmt::format("the deck has the contact '{}', of which the numerical errors are not known",
                        core::harmless(contact_line(text))));
    }
    scenario::Trough& trough = scenario.trough;
    int const steps = steps_per_cycle(folder / deck::drive_file).value_or(run.prepared.time.steps_per_cycle);
    double const frequency = 1 / (steps * time_step(text).value_or(1 / (trough.frequency * steps)));
    prepare::PreparedCase as_run = run.prepared;
    as_run.time.steps_per_cycle = steps;
    measure::PhaseSeries const phases = packing_phases(as_run, read_packing_files(folder).phases);
    double const along = first_harmonic(phases.trough_x), normal = first_harmonic(phases.trough_z);
    double const amplitude = std::hypot(along, normal), angle = std::atan2(normal, along);
    if (phases.cycles() == 0 || !(amplitude > 0)) return;
    // The amplitude and the angle of a record may differ from those of the keys.
    double const asked_along = fundamental_of(run.prepared.motion.along),
                 asked_normal = fundamental_of(run.prepared.motion.normal);
    double const asked = std::hypot(asked_along, asked_normal),
                 asked_angle = std::atan2(asked_normal, asked_along);
    if (std::abs(amplitude / asked - 1) < as_asked && std::abs(angle - asked_angle) < as_asked &&
        std::abs(frequency / trough.frequency - 1) < as_asked)
        return;
    run.changes.push_back(
        fmt::format("the trough moved with an amplitude of {:.6g} mm at {:.5g} deg and {:.6g} Hz, and not "
                    "with {:.6g} mm, "
                    "{:.5g} deg and {:.6g} Hz of the scenario",
                    1e3 * amplitude, scenario::in_degrees(angle), frequency, 1e3 * asked,
                    scenario::in_degrees(asked_angle), trough.frequency));
    trough.amplitude = amplitude;
    trough.vibration_angle = angle;
    trough.frequency = frequency;
    trough.given = {};
    run.prepared = prepare::prepare_case(scenario);
    run.prepared.time = prepare::with_steps(run.prepared.time, steps);
}

/// How the engine's own output says that the run ended.
std::string end_of_run(fs::path const& folder) {
    for (char const* name : {"engine.out", "log.liggghts"}) {
        fs::path const path = folder / name;
        if (!is_file(path)) continue;
        std::string const text = core::read_file(path);
        auto const error = text.rfind("\nERROR");
        if (error != text.npos) {
            std::string const line = text.substr(error + 1, text.find('\n', error + 1) - error - 1);
            return fmt::format("{} says: {}", name, line);
        }
        return text.find(deck::end_marker) == text.npos
                   ? fmt::format("{} has no end marker: the run was stopped or goes on", name)
                   : fmt::format("{} has the end marker", name);
    }
    return "not known: there is no log.liggghts";
}

/// Leaves so many rows of a table, with the header and the comments before them.
void keep_rows(core::TextFile& table, long rows) {
    std::size_t end = 0;
    for (long left = rows + 1; left > 0;) {
        std::size_t const begin = end, line_end = table.content.find('\n', begin);
        if (line_end == std::string::npos) return;
        if (table.content[begin] != '#') --left;
        end = line_end + 1;
    }
    table.content.resize(end);
}

void measure_packing(HandRun& run, fs::path const& folder) {
    prepare::PreparedCase prepared = run.prepared;
    HandPacking packing{
        .folder = folder, .number = std::max(1, number_of(folder)), .end = end_of_run(folder)};
    if (auto const steps = steps_per_cycle(folder / deck::drive_file)) {
        prepared.time.steps_per_cycle = *steps;
        prepared.time.time_step = 1 / (prepared.scenario.trough.frequency * *steps);
    }
    PackingFiles files = read_packing_files(folder);
    packing.cycles = extent_of_run(prepared, folder).cycles;
    int const planned = prepared.scenario.measure.max_cycles;
    if (has_given_length(prepared.scenario) && packing.cycles > planned) {
        run.changes.push_back(fmt::format("packing {} ran {} cycles; the {} of the scenario are measured",
                                          packing.number, packing.cycles, planned));
        packing.cycles = planned;
        keep_rows(files.cycles, planned + 1);  // the first row is the start
        keep_rows(files.phases, static_cast<long>(planned) * measure::PhaseSeries::per_cycle);
    }
    if (packing.cycles < 2)
        throw core::InputError(
            fmt::format("{} holds {} whole cycles, and a mean needs two; let the run go on",
                        (folder / "cycles.csv").string(), packing.cycles));
    packing.efficiency = read_efficiency(prepared, folder, packing.cycles);
    long const last_step = static_cast<long>(packing.cycles) * prepared.time.steps_per_cycle;
    auto const evaluated = evaluate_outputs(prepared, packing.number, files, last_step);
    if (auto const* const record = std::get_if<store::PackingRecord>(&evaluated)) {
        packing.mode = record->motion.mode;
    } else {
        auto const& fault = std::get<UnusableOutputs>(evaluated);
        packing.fault = fault.outcome;
        packing.message = fault.message;
    }
    run.packings.push_back(std::move(packing));
}

}  // namespace

HandRun measure_by_hand(fs::path const& folder, fs::path const& scenario_file) {
    std::vector<fs::path> const folders = folders_with_runs(folder);
    fs::path const file = find_scenario(scenario_file, folders.front());
    HandRun run{file, read_case(file), {}, 0, {}, core::Outcome::finished};
    take_drive(run, folders.front());
    for (fs::path const& one : folders) measure_packing(run, one);
    run.cycles_used = std::ranges::min(run.packings, {}, &HandPacking::cycles).cycles;
    std::vector<measure::PackingValues> values;
    for (HandPacking const& packing : run.packings) {
        std::span const all(packing.efficiency);
        values.push_back({all.first(static_cast<std::size_t>(run.cycles_used)), start_of(packing.number)});
    }
    run.estimate = estimate_of(values, run.prepared.scenario);
    run.outcome = outcome_of(run.estimate, run.prepared.scenario);
    for (HandPacking const& packing : run.packings) {
        if (!packing.fault) continue;
        run.outcome = *packing.fault;
        break;
    }
    return run;
}

}  // namespace vibrotrough::evaluate
