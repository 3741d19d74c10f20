#pragma once

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

/// The steepest inclination of a design, in rad, at which |tan(alpha)| is 0.95 mu: beyond it the speed
/// depends on the last digit of the friction coefficient, and beyond mu it is unbounded.
double steepest_slope(double friction);

/// The inclinations of a range at which |tan(alpha)| <= 0.95 mu.
/// @throws std::invalid_argument when there are none
Range with_friction_margin(Range inclination, double friction);

}  // namespace vibrotrough::theory
