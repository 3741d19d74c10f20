#pragma once

#include "scenario/model/grains.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::scenario {

struct Trough;

/// A part of the drive's acceleration in addition to the fundamental, along the direction of vibration (Eq.
/// 22 of Sloot & Kruyt): - ratio sin(order omega t + phase), in units of the amplitude of the fundamental's
/// acceleration.
struct DriveHarmonic {
    int order;     ///< 2 to 100
    double ratio;  ///< to the acceleration of the fundamental, -10 to 10
    double phase;  ///< rad
    bool operator==(DriveHarmonic const&) const = default;  ///< Whether all members are equal.
};

/// One term of a Fourier series: amplitude * sin(order omega t + phase).
struct DriveTerm {
    int order;         ///< 1 for the fundamental
    double amplitude;  ///< m
    double phase;      ///< rad
    /// Whether all three numbers are equal.
    bool operator==(DriveTerm const&) const = default;
};

/// The displacement of the trough as two Fourier series. The time t is 0 at step 0 of a run.
struct DriveMotion {
    std::vector<DriveTerm> along;   ///< along the trough, x
    std::vector<DriveTerm> normal;  ///< normal to the trough, z
};

/// The motion of a trough: its waveform if it has one, otherwise the fundamental with the harmonics.
DriveMotion drive_motion(Trough const& trough);

/// Upper bound of the distance of the trough from its mean position, m, from the sums of the amplitudes.
double largest_excursion(DriveMotion const& motion);

/// Upper bound of the speed of the trough, m/s, from the sums of the amplitudes.
/// @param omega  angular frequency, rad/s
double largest_speed(DriveMotion const& motion, double omega);

/// Highest order of all terms, at least 1.
int highest_order(DriveMotion const& motion);

/// A measured motion of the trough, read and analysed once. Cases that name the same file share it.
struct Waveform {
    NamedFile file;           ///< name and text
    double frequency = 0;     ///< Hz, of its fundamental
    double amplitude = 0;     ///< m, of its fundamental in the direction of vibration
    double angle = 0;         ///< rad, of the fundamental with the trough, 0 to pi/2
    DriveMotion motion = {};  ///< the harmonics that are certain in the noise
    DriveMotion all = {};     ///< with those that are not
    std::vector<std::string> remarks =
        {};  ///< what was made of the file and what was left out, a sentence each
};

/// Reads a record of displacements or accelerations: one cycle without the first sample of the next, or one
/// and a half and more, evenly spaced, with any start. Harmonics of up to order 30 are fitted to its whole
/// cycles by least squares, beside the mean and, in three cycles or more, a drift (a parabola). Accelerations
/// are integrated. `motion` has the harmonics with an amplitude of more than four standard errors of what is
/// left, where at least 8 samples more than unknowns tell it; terms below 1e-6 of the largest amplitude are
/// left out. The time is 0 at the first sample.
/// @throws std::invalid_argument with one line that describes what is wrong with the text
std::shared_ptr<Waveform const> read_waveform(NamedFile file);

/// What is wrong with a waveform as the motion of a trough, and what to write instead.
struct WaveformFault {
    std::string wrong;    ///< everything that is wrong, in one line
    std::string instead;  ///< the keys that go with the waveform
};

/// Keys may differ by so much from a record, in which they are nominal values: 10 %, 0.1 rad.
inline constexpr double near_record = 0.1;

/// Whether a trough can have this waveform as its motion: the trough's frequency, amplitude and vibration
/// angle are those of the waveform's fundamental to `near_record`; and along and normal to the trough no
/// harmonic accelerates it by more than 1000 times as much as the fundamental, which is the range of the
/// theory. None when it can.
std::optional<WaveformFault> find_fault(Waveform const& waveform, Trough const& trough);

}  // namespace vibrotrough::scenario
