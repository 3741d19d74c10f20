#pragma once

#include "scenario/model/drive.hpp"
#include "scenario/model/engine_plan.hpp"
#include "scenario/model/feed.hpp"
#include "scenario/model/grains.hpp"
#include "scenario/model/materials.hpp"
#include "scenario/model/screen.hpp"
#include "scenario/model/stages.hpp"
#include "scenario/model/trough_mesh.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::scenario {

/// Acceleration of gravity where a trough does not say another, m/s^2.
constexpr double gravity = 9.81;

/// Solid fraction of a settled layer, if its height is taken as twice the height of its centre of mass.
/// Measured: 500 spheres of 2.7 to 3.3 mm with friction 0.5 on 36 mm x 18 mm settle to a centre of mass
/// at 9.58 mm, which gives 0.581.
constexpr double settled_solid_fraction = 0.58;

/// Numbers of the drive as the user gave them, where Trough holds a derived number instead. They are kept so
/// that a throw number of 2 stays 2 in every deck, table and file instead of being computed back from the
/// frequency. Code that changes the angles, amplitude or frequency of a Trough must clear them.
struct GivenDrive {
    std::optional<double> throw_number = {};         ///< Gamma
    std::optional<double> machine_number = {};       ///< K
    std::optional<double> tan_vibration_angle = {};  ///< tan(beta)
    std::optional<double> tan_inclination = {};      ///< tan(alpha)
    bool is_stroke = false;                          ///< the amplitude, as a stroke
    bool is_turns = false;                           ///< the frequency, in turns of the drive
    std::string replaced = {};  ///< numbers that a record has replaced, in a sentence; empty without
};

/// The trough and its drive. The fundamental is along the direction of vibration.
struct Trough {
    double inclination;      ///< alpha, rad, uphill positive in the conveying direction
    double vibration_angle;  ///< beta, rad, between the direction of vibration and the trough, [0, pi/2]
    double amplitude;        ///< r, m, in the direction of vibration: half the stroke
    double frequency;        ///< 1/T, Hz
    double friction;         ///< mu, coefficient of grain on trough
    double restitution;      ///< e, coefficient of grain on trough
    std::optional<double> side_wall_friction =
        {};                  ///< coefficient of grain on side wall; periodic across without
    double along_phase = 0;  ///< rad, lead of x over z, which makes the drive elliptical
    std::vector<DriveHarmonic> harmonics = {};           ///< in addition to the fundamental
    std::shared_ptr<Waveform const> waveform = nullptr;  ///< a measured motion instead of the sinusoid
    std::optional<int> waveform_order = {};  ///< highest one kept; without it, those above the noise
    GivenDrive given = {};                   ///< numbers as the user gave them
    MeshUnit mesh_unit = MeshUnit::mm;       ///< of the file of `mesh`
    std::shared_ptr<TroughMesh const> mesh = nullptr;  ///< a surface instead of the flat floor
    std::optional<double> width = {};                  ///< m, of the real trough; see trough_width()
    double gravity = scenario::gravity;                ///< g, m/s^2
};

/// One stage with everything that holds for it. At the end of every cycle the trough is back where it was at
/// the beginning of the run: its displacement in a cycle with the angle phi is X(phi) - X(0), with the motion
/// X of its drive. In a ramp of the length t_r the displacement goes over linearly from that of the stage
/// before to that of this one, and the frequency does so, too: phi(t) = 2 pi (f_1 t + (f_2 - f_1) t^2 / (2
/// t_r)). Position and velocity of the trough are continuous at both ends of the ramp. A trough that stands
/// still has the displacement 0 and keeps the frequency of its neighbour.
struct Stage {
    Trough trough;           ///< with the drive of the stage; at a standstill with that of the stage before
    bool standstill;         ///< the trough stands still, but for the ramp
    int first_cycle;         ///< number of cycles before the stage
    int cycles;              ///< at least 1, with those of the ramp
    int ramp_cycles;         ///< of the ramp at its beginning; 0 without a ramp
    double first_frequency;  ///< Hz, with which the ramp begins
    double start;            ///< s, when the stage begins
    double mass_flow = 0;    ///< kg/s, fed into an open trough

    double ramp_time() const;  ///< s
    double time() const;       ///< s, with the ramp
};

/// A single rigid body that replaces the layer and represents the point mass of the theory.
enum class Block {
    none,   ///< there is a layer
    point,  ///< one sphere that cannot rotate
    plate,  ///< a rigid body of three by three spheres that can rotate
};

/// The word of the campaign file, or "none".
std::string_view name_of(Block block);

/// A piece of an endless layer: periodic along the trough, and across unless there are side walls. One of
/// `height`, `grains` and `block` was given; `grains` is always set. Of an open trough it is what the feed
/// will probably keep in it.
struct Layer {
    double length;                         ///< m, along x; of an open trough from the back wall to the edge
    double width;                          ///< m, along y
    std::optional<double> height;          ///< m, at rest, as asked for
    int grains;                            ///< number of grains; 1 for a block
    Block block = Block::none;             ///< what replaces the layer, if anything
    std::optional<double> diameters = {};  ///< height in mean diameters of the grains, where it was given so
};

/// What is measured, and how precisely.
struct MeasurementPlan {
    int packings;           ///< least number of independent packings per case
    double confidence;      ///< level of every interval, e.g. 0.95
    double half_width;      ///< wanted of the case's velocity efficiency, statistics and numerics together
    int max_cycles;         ///< largest number of cycles of a packing
    int max_packings = 24;  ///< largest number of packings of a case
    std::optional<double> max_core_time{};  ///< s, largest core time that a case may take
    std::optional<int> min_cycles{};        ///< least number of cycles of a packing
};

/// What a run writes in addition to its measurements.
struct OutputPlan {
    int frames_per_cycle;                   ///< frames for ParaView per cycle; 0 writes none
    int checkpoint_cycles = 50;             ///< cycles between two checkpoints; 0 writes none
    std::vector<int> frame_packings = {1};  ///< packings that write frames, in order; none: all of them
    bool contacts = false;                  ///< whether the frames have the contacts of the grains, too
};

/// Whether packing number `packing` (from 1) writes frames.
bool writes_frames(OutputPlan const& output, int packing);

/// How many of the packings 1 to `packings` write frames.
int packings_with_frames(OutputPlan const& output, int packings);

/// Numerical settings, on which the results should depend as little as possible.
struct SolverPlan {
    double rayleigh_fraction = 0.2;  ///< upper bound of time step / Rayleigh time of the smallest grain
    double softness = 0.079;       ///< rad, largest wave_number() (softness.hpp) of grains without a modulus
    double block_stiffness = 300;  ///< duration of a cycle / duration of a block's contact
};

/// One validated case. SI units throughout.
struct Scenario {
    std::string campaign;     ///< name of the campaign: letters, digits, '.', '_', '-'
    Trough trough;            ///< and its drive
    Grains grains;            ///< size, shape and material; of the first material if there are several
    Layer layer;              ///< size of the layer
    MeasurementPlan measure;  ///< packings, cycles, precision
    OutputPlan output;        ///< frames and checkpoints
    SolverPlan solver = {};   ///< numerical settings
    EnginePlan engine = {};   ///< what is asked of the engine beyond what its probes test
    std::vector<AddedMaterial> materials = {};  ///< that are mixed with the grains; see materials()
    std::vector<MaterialPair> pairs = {};       ///< contacts of two materials
    Feed feed = {};                             ///< of an open trough
    Screen screen = {};                         ///< in place of the closed floor
    std::vector<GivenStage> stages = {};        ///< of the drive; none: the drive of the trough without end
};

double angular_frequency(Trough const& trough);  ///< Angular frequency omega, rad/s.
double machine_number(Trough const& trough);     ///< K = omega^2 r / g, as given where it was given.
/// Gamma = omega^2 r sin(beta) / (g cos(alpha)), as given where it was given.
double throw_number(Trough const& trough);

/// The frequency that follows from the given throw number or machine number, Hz: f = sqrt(K g / r) / (2 pi)
/// with K = Gamma cos(alpha) / sin(beta). That of the trough when neither is given.
double frequency_of(Trough const& trough);

/// An angle (rad) in degrees: the shortest decimal number that converts back to this angle to within
/// rounding, so that 30 degrees are printed as 30 and not as 29.999999999999996.
double in_degrees(double radian);

/// Whether the trough vibrates normal to itself only.
bool is_vertical(Trough const& trough);

/// r cos(beta), m, the amplitude along the trough, in which displacements along it are expressed; r for a
/// trough that vibrates normal to itself only.
double length_scale(Trough const& trough);

/// omega r cos(beta), m/s: the conveying speed at a velocity efficiency of 1, from length_scale().
double velocity_scale(Trough const& trough);

/// Density of the settled layer with its voids, kg/m^3: that of the grains times settled_solid_fraction.
double bulk_density(Grains const& grains);

/// Mass of the layer per area of trough, kg/m^2, from the number of grains and their mean volume.
double mass_per_area(Scenario const& scenario);

/// Width of the trough for its mass flow, m: as given, or between the side walls. None for a layer that is
/// periodic across, which is a piece out of a trough of any width.
std::optional<double> trough_width(Scenario const& scenario);

/// Volume of the layer at rest per area of trough in plan, m, from the number of grains and
/// settled_solid_fraction.
double mean_layer_depth(Scenario const& scenario);

/// Height of the layer at rest, m: as given, otherwise from the number of grains and settled_solid_fraction.
/// On a mesh it is the level above the lowest point; in an open trough, whose floor may fall or rise, above
/// the lowest point of a cross-section, as a mean along it.
double layer_height(Scenario const& scenario);

/// What was mended or left out of the files that the scenario names, a sentence each.
std::vector<std::string> remarks(Scenario const& scenario);

/// The files that the scenario names: shape, waveform and templates, if it has
/// them.
std::vector<NamedFile> named_files(Scenario const& scenario);

}  // namespace vibrotrough::scenario
