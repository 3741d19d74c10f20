#include "measure/layer_mode.hpp"

#include "measure/constants.hpp"

#include <algorithm>
#include <cmath>

namespace vibrotrough::measure {
namespace {

/// Indices wrap around because the curves are periodic.
std::size_t wrapped(int i, std::size_t size) {
    int const n = static_cast<int>(size);
    return static_cast<std::size_t>(((i % n) + n) % n);
}

char letter_at(ModeCurves const& curves, int i) {
    std::size_t const n = curves.slip.size();
    std::size_t const here = wrapped(i, n);
    auto const flies = [&](std::size_t k) { return curves.normal_force[k] < flight_force; };
    if (flies(here)) return 'F';
    double const v = curves.slip[here];
    std::size_t const before = wrapped(i - 1, n), after = wrapped(i + 1, n);
    // The change of slip on the side that is in contact, because the slip jumps at a landing.
    double change = 0;
    int sides = 0;
    if (!flies(before)) change += std::abs(v - curves.slip[before]), ++sides;
    if (!flies(after)) change += std::abs(curves.slip[after] - v), ++sides;
    bool const still = sides == 0 || change / sides < rest_change * curves.step;
    if (std::abs(v) < rest_slip && still) return 'R';
    return v > 0 ? 'P' : 'N';
}

struct Run {
    char letter;
    int first, length;
};

std::vector<Run> runs_of(std::vector<char> const& letters) {
    std::vector<Run> runs;
    for (std::size_t i = 0; i < letters.size(); ++i) {
        if (!runs.empty() && runs.back().letter == letters[i]) {
            ++runs.back().length;
        } else {
            runs.push_back({letters[i], static_cast<int>(i), 1});
        }
    }
    // The last run may continue in the first one.
    if (runs.size() > 1 && runs.front().letter == runs.back().letter) {
        runs.back().length += runs.front().length;
        runs.erase(runs.begin());
    }
    return runs;
}

bool between_flights(std::vector<Run> const& runs, std::size_t i) {
    int const k = static_cast<int>(i);
    return runs[i].letter != 'F' && runs[wrapped(k - 1, runs.size())].letter == 'F' &&
           runs[wrapped(k + 1, runs.size())].letter == 'F';
}

/// Stray grains that land before the layer do not end its flight: a contact between two flights with too
/// small an impulse counts as flight.
void forget_stray_grains(ModeCurves const& curves, std::vector<Run>& runs, std::vector<char>& letters) {
    // The slides and rests of one contact belong together.
    std::vector<char> contact = letters;
    for (char& letter : contact) letter = letter == 'F' ? 'F' : 'C';
    for (Run const& run : runs_of(contact)) {
        if (run.letter == 'F' || run.length == static_cast<int>(letters.size())) continue;
        double impulse = 0;  // in units of weight times period
        for (int i = 0; i < run.length; ++i)
            impulse += curves.normal_force[wrapped(run.first + i, letters.size())] * curves.step / two_pi;
        if (impulse >= stray_impulse) continue;
        for (int i = 0; i < run.length; ++i) letters[wrapped(run.first + i, letters.size())] = 'F';
    }
    runs = runs_of(letters);
}

/// Merges the shortest run that is too short with its longer neighbour in contact; returns false if there is
/// none. A contact between two flights is kept even if it is short, because it is a landing.
bool absorb_shortest(std::vector<Run>& runs, std::vector<char>& letters) {
    std::size_t const n = runs.size();
    if (n < 2) return false;
    std::size_t chosen = n;
    for (std::size_t i = 0; i < n; ++i) {
        if (runs[i].length >= shortest_phase || between_flights(runs, i)) continue;
        if (chosen == n || runs[i].length < runs[chosen].length) chosen = i;
    }
    if (chosen == n) return false;
    Run const& before = runs[wrapped(static_cast<int>(chosen) - 1, n)];
    Run const& after = runs[wrapped(static_cast<int>(chosen) + 1, n)];
    bool const flight_before = before.letter == 'F', flight_after = after.letter == 'F';
    bool const take_before = flight_before != flight_after ? flight_after : before.length >= after.length;
    char const letter = take_before ? before.letter : after.letter;
    for (int i = 0; i < runs[chosen].length; ++i)
        letters[wrapped(runs[chosen].first + i, letters.size())] = letter;
    runs = runs_of(letters);
    return true;
}

/// The run with which the period begins: the longest flight, otherwise the first slide after phase 0.
std::size_t start_of(std::vector<Run> const& runs) {
    auto const slides = [](Run const& run) { return run.letter == 'P' || run.letter == 'N'; };
    std::size_t start = runs.size();
    for (std::size_t i = 0; i < runs.size(); ++i) {
        if (runs[i].letter == 'F' && (start == runs.size() || runs[i].length > runs[start].length)) start = i;
    }
    for (std::size_t i = 0; i < runs.size() && start == runs.size(); ++i) {
        if (slides(runs[i])) start = i;
    }
    return start == runs.size() ? 0 : start;
}

}  // namespace

std::vector<ModePhase> mode_phases(ModeCurves const& curves) {
    std::vector<char> letters;
    for (int i = 0; i < static_cast<int>(curves.slip.size()); ++i) letters.push_back(letter_at(curves, i));
    std::vector<Run> runs = runs_of(letters);
    forget_stray_grains(curves, runs, letters);
    while (absorb_shortest(runs, letters)) {
    }
    std::vector<ModePhase> phases;
    std::size_t const start = start_of(runs);
    for (std::size_t k = 0; k < runs.size(); ++k) {
        std::size_t const i = (start + k) % runs.size();
        Run const& run = runs[i];
        // The layer lands and is thrown again at once: two flights with no contact between them.
        if (run.length < shortest_phase && between_flights(runs, i)) continue;
        std::string letter(1, run.letter);
        bool const landed = k > 0 && phases.back().letter == "F";
        if (landed && (run.letter == 'P' || run.letter == 'N')) letter += '\'';
        phases.push_back({letter, run.first, run.length});
    }
    return phases;
}

std::string mode_name(std::vector<ModePhase> const& phases) {
    std::string name;
    for (ModePhase const& phase : phases) name += phase.letter;
    return name;
}

}  // namespace vibrotrough::measure
