#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace vibrotrough::theory {

/// The values that a quantity may take.
struct Range {
    double low, high;  ///< ends of the range, both included
};

/// What is set on a machine.
struct Drive {
    double frequency;        ///< Hz
    double amplitude;        ///< r, m, in the direction of vibration
    double vibration_angle;  ///< beta, rad, within (0, pi/2)
    double inclination;      ///< alpha, rad, uphill positive

    double angular_frequency() const;                  ///< omega, rad/s
    double trough_speed() const;                       ///< omega r cos(beta), m/s
    double machine_number(double gravity) const;       ///< K = omega^2 r / g
    double throw_number(double gravity = 9.81) const;  ///< Gamma = K sin(beta) / cos(alpha)
};

/// The drives among which a search may choose.
struct DriveSpace {
    Range frequency{5, 60};                 ///< Hz
    Range amplitude{0.0005, 0.015};         ///< m
    Range vibration_angle{0.0873, 1.0472};  ///< rad, within (0, pi/2)
    Range inclination{0, 0};                ///< rad, within (-pi/2, pi/2)
    double max_machine_number = 5;          ///< K: what the structure can bear
    double max_throw_number =
        3.29;               ///< Gamma: landings become irregular when a flight lasts more than one cycle
    double gravity = 9.81;  ///< m/s^2
};

/// @throws std::invalid_argument when a range is empty or makes no sense
void check(DriveSpace const& space);

/// How much the numbers of a drive exceed those allowed: the larger of log(K / K_max) and
/// log(Gamma / Gamma_max). Zero or less within the limits; the ranges are not looked at.
double excess(DriveSpace const& space, Drive const& drive);

/// A number that depends on the drive.
using DriveFunction = std::function<double(Drive const&)>;

/// How long best_drive() searches.
struct DriveSearchSettings {
    int global_evaluations = 60000;  ///< of ISRES
    int local_evaluations = 4000;    ///< of COBYLA, after it
};

/// Finds the drive with the largest merit: NLopt's ISRES over logarithms of frequency and amplitude and the
/// two angles, refined by COBYLA. The search is random with a fixed seed. The answer is the best of all
/// drives that were looked at and that keep every limit, without any tolerance.
/// @param merit     not finite where the drive cannot be used
/// @param excesses  further limits: each is relative, such as log(value / limit), and must not be positive
/// @return nothing when no drive that keeps all limits was found
/// @throws std::invalid_argument as check(), and when even the lowest frequency and amplitude exceed the
/// largest machine number or throw number
std::optional<Drive> best_drive(DriveSpace const& space, DriveFunction const& merit,
                                std::vector<DriveFunction> const& excesses = {},
                                DriveSearchSettings const& settings = {});

}  // namespace vibrotrough::theory
