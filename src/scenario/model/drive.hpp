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

/// One measured cycle of the trough, read and analysed once. Cases that name the same file share it.
struct Waveform {
    NamedFile file;             ///< name and text
    std::vector<double> times;  ///< s, of the samples
    DriveMotion motion;         ///< the same motion as a Fourier series, which holds for every frequency
};

/// Reads a measured cycle. The CSV text has the header "time_s,x_m,z_m" and at least 8 samples, the first at
/// 0, without the first sample of the next cycle. The mean, terms below 1e-6 of the largest amplitude and
/// orders above 30 are left out.
/// @throws std::invalid_argument with one line that describes what is wrong with the text
std::shared_ptr<Waveform const> read_waveform(NamedFile file);

/// Checks that the samples divide one period evenly, each within 1e-3 of the spacing.
/// @param period  s
/// @throws std::invalid_argument with one line that names the first sample for which this is not true
void check_samples(Waveform const& waveform, double period);

/// What is wrong with a waveform as the motion of a trough, and what to write instead.
struct WaveformFault {
    std::string wrong;    ///< everything that is wrong, in one line
    std::string instead;  ///< the keys that go with the waveform
};

/// Whether a trough can have this waveform as its motion: the samples divide one cycle (check_samples());
/// the trough's amplitude and vibration angle, on which theory, throw number and efficiency are based, are
/// those of the waveform's fundamental, to 1 % and 0.01 rad; and along and normal to the trough no harmonic
/// accelerates it by more than 1000 times as much as the fundamental, which is the range of the theory.
/// None when it can.
std::optional<WaveformFault> find_fault(Waveform const& waveform, Trough const& trough);

}  // namespace vibrotrough::scenario
