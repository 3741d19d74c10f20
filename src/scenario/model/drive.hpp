#pragma once

#include <string_view>
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

/// One measured cycle as a Fourier series. `csv` has the header "time_s,x_m,z_m" and at least 8 evenly spaced
/// samples, the first at 0, the next cycle's first left out. Terms below 1e-6 of the largest amplitude, the
/// mean, and what is beyond order 30 are left out.
/// @throws std::invalid_argument one line that says what is wrong with the text
DriveMotion read_waveform(std::string_view csv, double period);

}  // namespace vibrotrough::scenario
