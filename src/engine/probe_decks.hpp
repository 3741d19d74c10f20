#pragma once

#include "engine/contact_law.hpp"

#include <array>
#include <map>
#include <string>
#include <vector>

/// The decks of `probe_engine`: what is asked of the engine. `probe_verdicts` knows what should come out.
namespace vibrotrough::engine {

/// A folder for the engine.
struct ProbeDeck {
    std::string name;                          ///< of the folder
    std::map<std::string, std::string> files;  ///< name and content
};

/// Nominal restitution of grain types 1 to 5 of an impact deck.
constexpr std::array<double, 5> probed_restitutions{0.1, 0.3, 0.5, 0.7, 0.9};
/// Friction between grain and floor in the decks of impacts.
constexpr double impact_friction = 0.23;

/// Grain number (from 1) is its place in this list; type t has probed_restitutions[t - 1].
struct Impact {
    int type;                 ///< of the grain, from 1
    double normal_speed;      ///< m/s
    double tangential_speed;  ///< m/s
    double gap;               ///< m, between grain and floor at the start
};

std::vector<Impact> const& fine_impacts();  ///< at a step that hides nothing of the law: 1/1000 of a contact
std::vector<Impact> const& coarse_impacts();  ///< at 20 % of the Rayleigh time, the decks' longest step

/// The material of all probes: grains of 3 mm as in the facts that the contact options were chosen by.
/// Friction and restitution are the given ones.
ContactMaterial probe_material(double restitution, double friction);

/// Grains on an inclined floor, with and without enough friction to hold them.
struct Incline {
    double angle = 0.3490658503988659;  ///< rad, 20 degrees: tan = 0.364
    double holding_friction = 0.8;      ///< of grains 1 and 3
    double sliding_friction = 0.23;     ///< of grain 2
    double time_step = 5e-6;            ///< s
    int steps = 20000;                  ///< time steps of the run
    int sample_steps = 200;             ///< time steps between two samples
};

/// A trough that moves along the direction of vibration from step 0 on, and grains that are held where they
/// are.
struct MovingTrough {
    double amplitude_x, amplitude_z;  ///< m
    double period = 0.05;             ///< s
    int steps = 500;                  ///< per period: the fewest that a deck uses
    int grains;                       ///< number of grains
};

MovingTrough sliding_trough();  ///< along itself, under grains that touch it
MovingTrough flying_trough();   ///< as in a campaign, out of the grain's way

/// Overlap at which one contact carries a grain's weight at this inclination, m.
double resting_overlap(double inclination);

/// The impacts of fine_impacts().
ProbeDeck fine_impact_deck();
/// The impacts of coarse_impacts().
ProbeDeck coarse_impact_deck();
/// Three grains on the floor of Incline.
ProbeDeck incline_deck();
/// Grains that rest on a floor under their own weight.
ProbeDeck contact_deck();
/// The two troughs, which must move as asked.
ProbeDeck drive_deck();

/// A layer of about a thousand grains on a moving trough.
ProbeDeck speed_deck(int steps);

/// SHA-256 of all the decks (and of how they are judged, by a number that is raised with it).
std::string digest_of_probes();

}  // namespace vibrotrough::engine
