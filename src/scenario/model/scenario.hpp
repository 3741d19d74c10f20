#pragma once

#include "scenario/model/drive.hpp"
#include "scenario/model/grains.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::scenario {

/// Acceleration of gravity used by theory, decks and tables, m/s^2.
constexpr double gravity = 9.81;

/// Solid fraction of a settled layer whose height is twice that of its centre of mass. Measured: 500 spheres
/// of 2.7 to 3.3 mm with friction 0.5 on 36 mm x 18 mm settle to a centre of mass at 9.58 mm, which is 0.581.
constexpr double settled_solid_fraction = 0.58;

/// Numbers of the drive as the user gave them, where they are not the ones that Trough holds. They are kept
/// so that a throw number of 2 stays 2 in every deck, table and file instead of being computed back from the
/// frequency. Whoever changes a Trough's angles, amplitude or frequency clears them.
struct GivenDrive {
    std::optional<double> throw_number = {}, machine_number = {}, tan_vibration_angle = {},
                          tan_inclination = {};
};

/// The trough and its drive. The fundamental is along the direction of vibration.
struct Trough {
    double inclination;      ///< alpha, rad, uphill positive in the conveying direction
    double vibration_angle;  ///< beta, rad, between the direction of vibration and the trough, [0, pi/2)
    double amplitude;        ///< r, m, in the direction of vibration: half the stroke
    double frequency;        ///< 1/T, Hz
    double friction;         ///< mu, grain on trough
    double restitution;      ///< e, grain on trough, nominal value of the contact model
    std::optional<double> side_wall_friction = {};  ///< grain on side walls; without it periodic across
    double along_phase = 0;                         ///< rad, of x against z: an elliptical drive
    std::vector<DriveHarmonic> harmonics = {};
    std::shared_ptr<Waveform const> waveform = nullptr;  ///< a measured motion instead of the sinusoid
    GivenDrive given = {};
};

/// A single rigid body in place of the layer: the point mass of the theory.
enum class Block {
    none,
    point,  ///< one sphere that cannot rotate
    plate,  ///< three by three spheres, one rigid body that can
};

/// "none", or the word of the campaign file.
std::string_view name_of(Block block);

/// A piece of an endless layer: periodic along the trough, and across unless there are side walls. One of
/// `height`, `grains` and `block` was given; `grains` is always set.
struct Layer {
    double length;                 ///< m, along x
    double width;                  ///< m, along y
    std::optional<double> height;  ///< m, at rest, as asked for
    int grains;                    ///< number of grains; 1 for a block
    Block block = Block::none;
};

struct MeasurementPlan {
    int packings;       ///< independent packings per case
    double confidence;  ///< of every interval, e.g. 0.95
    double half_width;  ///< of velocity efficiency, wanted of each packing
    int max_cycles;     ///< per packing
};

struct OutputPlan {
    int frames_per_cycle;        ///< of the first packing; 0 writes none
    int checkpoint_cycles = 50;  ///< between checkpoints; 0 writes none
};

/// What the numbers depend on beside physics.
struct SolverPlan {
    double rayleigh_fraction = 0.2;  ///< time step over the smallest grain's Rayleigh time, at most
    double block_stiffness = 300;    ///< a block's contact lasts the cycle divided by this
};

/// One validated case. SI units throughout.
struct Scenario {
    std::string campaign;  ///< name of the campaign: letters, digits, '.', '_', '-'
    Trough trough;
    Grains grains;
    Layer layer;
    MeasurementPlan measure;
    OutputPlan output;
    SolverPlan solver = {};
};

double angular_frequency(Trough const& trough);  ///< omega, rad/s
double machine_number(Trough const& trough);     ///< K = omega^2 r / g
double throw_number(Trough const& trough);       ///< Gamma = omega^2 r sin(beta) / (g cos(alpha))

/// An angle (rad) in degrees: the shortest decimal number that converts to this angle within one unit in the
/// last place, so that 30 degrees are printed as 30 and not as 29.999999999999996.
double in_degrees(double radian);

/// omega r cos(beta), m/s: what one unit of velocity efficiency is worth.
double velocity_scale(Trough const& trough);

/// Height of the layer at rest, m: as asked for, else from the number of grains.
double layer_height(Scenario const& scenario);

/// The case as a campaign file of its own, in SI units with 17 digits: the same scenario always gives the
/// same text, and reading the text gives the same scenario. Files that it names stand beside it.
std::string to_toml(Scenario const& scenario);

/// The files that the scenario names: shape and waveform.
std::vector<NamedFile> named_files(Scenario const& scenario);

}  // namespace vibrotrough::scenario
