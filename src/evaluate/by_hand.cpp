#include "evaluate/by_hand.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "deck/deck.hpp"
#include "evaluate/case.hpp"
#include "evaluate/packing.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <algorithm>
#include <charconv>
#include <map>
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
    int number = 0;
    if (name.starts_with(begin))
        std::from_chars(name.data() + begin.size(), name.data() + name.size(), number);
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

HandPacking measure_packing(prepare::PreparedCase prepared, fs::path const& folder) {
    HandPacking packing{
        .folder = folder, .number = std::max(1, number_of(folder)), .end = end_of_run(folder)};
    if (auto const steps = steps_per_cycle(folder / deck::drive_file)) {
        prepared.time.steps_per_cycle = *steps;
        prepared.time.time_step = 1 / (prepared.scenario.trough.frequency * *steps);
    }
    PackingFiles const files = read_packing_files(folder);
    packing.cycles = extent_of_run(prepared, folder).cycles;
    if (packing.cycles < 2)
        throw core::InputError(
            fmt::format("{} holds {} whole cycles, and a mean needs two; let the run go on",
                        (folder / "cycles.csv").string(), packing.cycles));
    packing.efficiency = read_efficiency(prepared, folder, packing.cycles);
    long const last_step = static_cast<long>(packing.cycles) * prepared.time.steps_per_cycle;
    auto const evaluated = evaluate_outputs(prepared, packing.number, files, last_step, DeckOf::hand);
    if (auto const* const record = std::get_if<store::PackingRecord>(&evaluated)) {
        packing.mode = record->motion.mode;
    } else {
        auto const& fault = std::get<UnusableOutputs>(evaluated);
        packing.fault = fault.outcome;
        packing.message = fault.message;
    }
    return packing;
}

}  // namespace

HandRun measure_by_hand(fs::path const& folder, fs::path const& scenario_file) {
    std::vector<fs::path> const folders = folders_with_runs(folder);
    fs::path const file = find_scenario(scenario_file, folders.front());
    HandRun run{file, read_case(file), {}, 0, {}, core::Outcome::finished};
    for (fs::path const& one : folders) run.packings.push_back(measure_packing(run.prepared, one));
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
