#pragma once

#include "engine/certificate.hpp"
#include "engine/probe_decks.hpp"

#include <filesystem>
#include <string>
#include <vector>

// Is the engine right when grains differ much in size? Velocity-Verlet adds up the tangential spring of a
// contact with velocities half a step behind the normal, and codes were found in which small grains get
// caught between large ones from a size ratio of about 3 on (Vyas, Ottino, Lueptow & Umbanhowar, Computer
// Physics Communications 310, 2025, 109524). Two experiments with three grains, whose answers are known, ask
// the engine.
namespace vibrotrough::engine {

/// Three equal materials: a small grain above the point where two large grains touch, which it rolls over.
struct GapRoll {
    double small_diameter = 0.001;             ///< m
    double start_angle = 0.17453292519943295;  ///< rad from the vertical, 10 degrees
    double end_angle = 0.6981317007977318;     ///< rad, 40 degrees
};

/// The time in which the small grain rolls from start_angle to end_angle, s.
///
/// The two large grains, of radius R, touch; the line through their centres is horizontal. The small grain,
/// of radius r, touches both and turns around that line at the distance L = sqrt((R + r)^2 - R^2). By
/// symmetry both contacts roll, with the lever arm r L / (R + r), so that the kinetic energy is m L^2 phi'^2
/// / 2 (1 + 2/5
/// ((R + r) / L)^2) and phi'' = g sin(phi) / (L (1 + 2/5 ((R + r) / L)^2)). The friction that this needs
/// stays below 0.75 of the limit for mu = 0.5 and all ratios.
/// @param ratio  R / r
double rolling_time(GapRoll const& roll, double ratio);

/// Two large grains that squeeze a small one. Its contacts are at an angle beside the line of the large
/// grains' centres. As in the nip of a roller crusher, friction holds it when the tangent of this angle is
/// below the friction coefficient, whatever the sizes, and it is expelled otherwise.
struct Nip {
    double small_diameter = 0.001;               ///< m
    double beside_limit = 0.017453292519943295;  ///< rad, 1 degree below and above the limit
    double speed = 0.002;                        ///< m/s, of each large grain
    double duration = 0.01;                      ///< s
    double held = 0.01;                          ///< most displacement of a grain that is held, in radii
    double expelled = 0.05;                      ///< least displacement of one that is expelled, in radii
};

/// The deck of GapRoll: one group of three for each of deck::probed_size_ratios.
ProbeDeck gap_roll_deck();
/// The deck of Nip: for each ratio a group below and a group above the limit.
ProbeDeck nip_deck();

/// See judge_fine_impacts().
std::vector<ProbeResult> judge_gap_roll(std::filesystem::path const& folder, std::string const& problem);
/// See judge_fine_impacts().
std::vector<ProbeResult> judge_nip(std::filesystem::path const& folder, std::string const& problem);

}  // namespace vibrotrough::engine
