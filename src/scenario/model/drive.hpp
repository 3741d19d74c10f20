#pragma once

#include "scenario/model/grains.hpp"

#include <memory>
#include <vector>

namespace vibrotrough::scenario {

struct Trough;

/// A part of the drive's acceleration beside the fundamental, along the direction of vibration (Eq. 22):
/// - ratio sin(order omega t + phase), in units of the fundamental's acceleration.
struct DriveHarmonic {
    int order;     ///< 2 to 100
    double ratio;  ///< of acceleration
    double phase;  ///< rad
    bool operator==(DriveHarmonic const&) const = default;
};

/// amplitude * sin(order omega t + phase)
struct DriveTerm {
    int order;
    double amplitude;  ///< m
    double phase;      ///< rad
};

/// The trough's displacement along (x) and normal to it (z) as Fourier series; step 0 is t = 0.
struct DriveMotion {
    std::vector<DriveTerm> along, normal;
};

/// The fundamental, the harmonics and the waveform of a trough, as one motion.
DriveMotion drive_motion(Trough const& trough);

/// Bounds (sums over the terms' amplitudes) of the trough's excursion from its mean position, m, and of its
/// speed, m/s, for angular frequency omega.
double largest_excursion(DriveMotion const& motion);
double largest_speed(DriveMotion const& motion, double omega);

/// Highest order of all terms.
int highest_order(DriveMotion const& motion);

/// One measured cycle of the trough, read and analysed once. Cases that name the same file share it.
struct Waveform {
    NamedFile file;
    std::vector<double> times;  ///< s, of the samples
    DriveMotion motion;         ///< the same motion as a Fourier series, whatever the frequency
};

/// Reads a measured cycle. The CSV text has the header "time_s,x_m,z_m" and at least 8 samples, the first at
/// 0, without the first sample of the next cycle. The mean, terms below 1e-6 of the largest amplitude and
/// orders above 30 are left out.
/// @throws std::invalid_argument with one line that says what is wrong with the text
std::shared_ptr<Waveform const> read_waveform(NamedFile file);

/// Checks that the samples divide one period (s) evenly, each within 1e-3 of the spacing.
/// @throws std::invalid_argument with one line that names the first sample at another time
void check_samples(Waveform const& waveform, double period);

}  // namespace vibrotrough::scenario
