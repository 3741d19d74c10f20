#pragma once

#include "scenario/scenario.hpp"

#include <filesystem>
#include <map>
#include <string>

namespace vibrotrough::deck {

/// How the run is cut into steps.
struct TimeGrid {
    double time_step;          ///< s
    int steps_per_cycle;       ///< whole, so that every sample is locked to the phase
    double rayleigh_fraction;  ///< time step / Rayleigh time of the smallest grain
    double hertz_fraction;     ///< time step / Hertz contact time of the smallest grain at `impact_speed`
    double impact_speed;       ///< m/s, the fastest impact reckoned with
};

/// One packing's input for the engine: a folder that `liggghts -in in.liggghts` runs by hand.
struct Deck {
    std::map<std::string, std::string> files;  ///< name and content
    TimeGrid time;
    int seed;       ///< of the packing, a prime as the engine wants it
    double mass;    ///< kg, of all grains
    double weight;  ///< N, what the layer at rest presses onto the trough: m g cos(alpha)
};

/// Lines that the deck prints and the driver looks for.
constexpr char const* end_marker = "VIBROTROUGH DONE";
constexpr char const* failure_marker = "VIBROTROUGH FAILED";
constexpr char const* settled_marker = "VIBROTROUGH SETTLED";

/// The file that the deck reads after each cycle, and its two contents.
constexpr char const* control_file = "control.in";
constexpr char const* control_go_on = "variable stop equal 0\n";
constexpr char const* control_stop = "variable stop equal 1\n";

/// Lines per cycle in phases.csv, evenly spaced; the last one is at phase 0.
constexpr int samples_per_cycle = 100;

/// The layer is cut into bins at this many phases, one after the other: every `profile_stride` of them, so
/// that each phase has its turn once in `profile_stride` cycles.
constexpr int profiles_per_cycle = 10;
constexpr int profile_stride = 3;

/// Time step: the smallest of 20 % of the Rayleigh time, 10 % of the Hertz contact time, 1/500 of a cycle,
/// and what makes the steps per cycle a multiple of samples_per_cycle and of the frames. Rayleigh time  T_R =
/// pi R sqrt(rho / G) / (0.1631 nu + 0.8766), G = E / (2 (1 + nu))
///   (Li, Xu & Thornton, Powder Technology 160, 2005).
/// Hertz contact  t_H = 2.87 (m*^2 / (R* E*^2 v))^(1/5) of two equal grains
///   (Johnson, Contact Mechanics, 1985, section 11.4), at v = 2 omega r: a grain that flies at the trough's
///   largest speed against a trough that comes at its largest speed.
/// @throws InputError when a cycle would take more than 1e8 steps
TimeGrid choose_time_step(Scenario const& scenario);

/// The deck of packing number `packing` (from 1). Different packings differ by their seeds only.
/// @throws std::invalid_argument when `packing` is below 1 or above 1000
Deck make_deck(Scenario const& scenario, int packing);

/// Writes the deck's files into the folder, which is made.
/// @throws MissingError when the disk refuses
void write_deck(Deck const& deck, std::filesystem::path const& folder);

}  // namespace vibrotrough::deck
