#pragma once

#include "core/template.hpp"
#include "engine/contact_law.hpp"

#include <array>
#include <map>
#include <string>
#include <vector>

/// The decks with which `probe_engine` tests an engine. `probe_verdicts` holds the expected results.
namespace vibrotrough::engine {

/// A deck folder.
struct ProbeDeck {
    std::string name;                          ///< name of the folder
    std::map<std::string, std::string> files;  ///< file names and contents
};

/// Nominal restitution coefficients of grain types 1 to 5 of an impact deck.
constexpr std::array<double, 5> probed_restitutions{0.1, 0.3, 0.5, 0.7, 0.9};
/// Friction between grain and floor in the decks of impacts.
constexpr double impact_friction = 0.23;

/// One impact. The number of the grain (from 1) is its position in the list of impacts; type t has
/// probed_restitutions[t - 1].
struct Impact {
    int type;                 ///< of the grain, from 1
    double normal_speed;      ///< m/s
    double tangential_speed;  ///< m/s
    double gap;               ///< m, initial distance between grain and floor
};

std::vector<Impact> const&
fine_impacts();  ///< with a time step of 1/1000 of a contact, which resolves the contact law
std::vector<Impact> const&
coarse_impacts();  ///< with 20 % of the Rayleigh time, the longest time step of campaign decks

/// The material of all probes: grains of 3 mm, as in the tests by which the contact options were chosen, with
/// the given friction and restitution.
ContactMaterial probe_material(double restitution, double friction);

/// Rayleigh time of a grain, s: pi R sqrt(rho / G) / (0.1631 nu + 0.8766) (Li, Xu & Thornton, Powder
/// Technology 160, 2005).
double rayleigh_time(ContactMaterial const& material);

/// The values of the template probes/world for grains of probe_material(0.5, 0.5) among themselves.
core::TemplateData probe_world(std::string const& title, double time_step);

/// Grains on an inclined floor, with and without enough friction to hold them.
struct Incline {
    double angle = 0.3490658503988659;  ///< rad, 20 degrees: tan = 0.364
    double holding_friction = 0.8;      ///< of grains 1 and 3
    double sliding_friction = 0.23;     ///< of grain 2
    double time_step = 5e-6;            ///< s
    int steps = 20000;                  ///< time steps of the run
    int sample_steps = 200;             ///< time steps between two samples
};

/// A trough that vibrates from step 0 on, under grains that are held in place.
struct MovingTrough {
    double amplitude_x, amplitude_z;  ///< m
    double period = 0.05;             ///< s
    int steps = 500;                  ///< per period: the smallest number that a campaign deck uses
    int grains;                       ///< number of grains
};

MovingTrough sliding_trough();  ///< moves in its own plane, under grains that touch it
MovingTrough flying_trough();   ///< moves as in a campaign, without touching the grain

/// The overlap at which one contact carries the weight of a grain at this inclination, m.
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

/// SHA-256 of all decks and of the version number of the verdicts.
std::string digest_of_probes();

}  // namespace vibrotrough::engine
