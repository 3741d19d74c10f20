#pragma once

#include "learn/uncertain.hpp"

#include <optional>
#include <vector>

namespace vibrotrough::learn {

/// Unbalanced motors. Their static moment is the sum of unbalanced mass times its distance from the shaft, of
/// all motors together.
///
/// Makers give one of three numbers: the static moment, which is mass times amplitude of the machine
/// (Italvibras' M_t = e P_v, e-catalogue p. 96); the working moment, twice as much, which is mass times
/// stroke (NetterVibration, "Formelsammlung": s = M / m and F = 54.84 M (n/1000)^2 with M in cm kg); or the
/// centrifugal force F = m_u r omega^2 at a speed.
struct Exciter {
    double static_moment;  ///< kg m, of all motors together, > 0
};

/// The exciter that has a centrifugal force at a frequency. @param force  N @param frequency  Hz
Exciter exciter_of_force(double force, double frequency);

/// N, the centrifugal force of an exciter at a frequency in Hz: F = m_u r omega^2. Two motors that turn
/// against each other give it along a line.
double force_of(Exciter const& exciter, double frequency);

/// An unbalance motor, set to its largest static moment.
struct Motor {
    double rpm;            ///< 1/min, synchronous
    double static_moment;  ///< kg m, of one motor
    double force;          ///< N, at that speed
    double power;          ///< W, installed
};

/// Two motors that turn against each other, and to what of their static moment both are set.
struct ChosenMotors {
    Motor motor;        ///< each of the two
    double setting;     ///< of the largest static moment, in (0, 1]
    bool is_converted;  ///< it runs from a frequency converter, well below its own speed
};

/// The smallest pair of motors that give a static moment (kg m, of both together) at a setting of 90 % or
/// less: of those of the slowest speed that is not below the drive's, which may be 2 % above it. Nothing
/// where none is large enough.
std::optional<ChosenMotors> choose_motors(std::vector<Motor> const& motors, double static_moment,
                                          double frequency);

/// Where it is known from which part of the material's mass moves with the trough.
enum class AddedMassSource {
    maker,  ///< what makers count with
    given,  ///< by the user
    atlas,  ///< layers that were simulated
};

/// The mass that an exciter moves, and its springs.
struct MovedMachine {
    double mass;                     ///< kg, of trough, motors and all that moves with them, without material
    double spring = 0;               ///< N/m, of all springs in the direction of vibration; 0 when very soft
    std::optional<Exciter> exciter;  ///< nothing: the one that is needed is looked for
    /// The part of the material's mass that moves with the trough. By default as NetterVibration counts;
    /// layers of spheres have 0.01 to 0.5 (validation/atlas), see settle_load().
    Uncertain added_mass = between_ends(0.10, 0.25);
    AddedMassSource added_mass_source = AddedMassSource::maker;  ///< where that is from
    /// The damping that the material adds, over its mass times omega; nothing where it is not known, and
    /// then none counts, as makers do. Layers of spheres have 0.18 on average (validation/atlas), see
    /// settle_load().
    std::optional<Uncertain> damping = {};
    std::vector<Motor> motors = {};  ///< among which a pair is chosen

    /// kg, that move with some material on the trough. @param material  kg
    double moving_mass(double material) const { return mass + added_mass.mean * material; }
};

/// m, the amplitude that an exciter gives: A = m_u r omega^2 / |k - m omega^2 + i c omega|, the response of
/// one mass on springs with the damping c of the material. Far above the resonance it is m_u r / |m - i c /
/// omega|, whatever the frequency.
/// @param material  kg, on the trough
/// @throws std::invalid_argument without an exciter, and within a fifth of the frequency of the resonance,
///   where the amplitude depends on the damping of springs and motors
double amplitude_of(MovedMachine const& machine, double frequency, double material);

/// m, one standard deviation of the amplitude, from what is not known of added mass and damping.
double amplitude_sd(MovedMachine const& machine, double frequency, double material);

/// The exciter that gives an amplitude, as above. @param amplitude  m
Exciter exciter_needed(MovedMachine const& machine, double frequency, double material, double amplitude);

/// Hz, of the resonance of the springs with the moving mass; 0 without springs.
double resonance_of(MovedMachine const& machine, double material);

/// What the springs of a machine do, as one mass on linear springs that are as stiff vertically as in the
/// direction of vibration.
struct Suspension {
    double sag;            ///< m, under the weight of trough and material: m g / k
    double empty, loaded;  ///< Hz, natural frequencies
    double isolation;      ///< part of the force that does not reach the building: 1 - 1 / ((f / f_n)^2 - 1)
    double force;          ///< N, amplitude of the force on the building: k r
    double at_start, at_stop;  ///< largest stroke while the resonance is passed, over the working one
};

/// s, in which motors come to speed, and to rest without a brake: typical, for Suspension.
inline constexpr double usual_start = 1, usual_stop = 10;
/// m: steel springs of such machines sag by 10 to 60 mm (natural frequencies of 2 to 5 Hz).
inline constexpr double largest_sag = 0.1;

/// m, by which springs sag under the weight of the machine and some material. @param spring  > 0
double sag_of(MovedMachine const& machine, double material);

/// @param material  kg, on the trough @param amplitude  m, of the working stroke
/// @throws std::invalid_argument without springs, and where the drive is slower than sqrt(2) times the
///   natural frequency, where springs isolate nothing
Suspension suspension_of(MovedMachine const& machine, double frequency, double material, double amplitude);

/// The largest amplitude, over the one far above the resonance, while a machine without damping passes that
/// resonance: 1 + 1.17 (omega_n / 2) sqrt(2 pi / a), with the angular acceleration a of its
/// motors, which is constant. The resonant part of the integral of Duhamel is one of Fresnel: by stationary
/// phase it ends at (omega_n / 2) sqrt(2 pi / a), and overshoots by 17 %; the forced motion, 1, adds to it
/// (after F.M. Lewis, Trans. ASME 54 (1932) 253-261).
/// @param natural  Hz @param frequency  Hz, that is reached @param time  s, in which it is reached
double passage_through_resonance(double natural, double frequency, double time);

/// W, that makers of crank drives install for a moved mass: F A omega / sqrt(2), with F the largest
/// acceleration times the mass. It reproduces the "drive capacity" of ROSTA's example (Oscillating
/// Mountings, p. 2.22).
double usual_drive_power(double mass, double amplitude, double frequency);

}  // namespace vibrotrough::learn
