#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace vibrotrough {

/// Acceleration of gravity used by theory, decks and tables, m/s^2.
constexpr double gravity = 9.81;

/// The trough and its sinusoidal drive along the direction of vibration.
struct Trough {
    double inclination;      ///< alpha, rad, uphill positive in the conveying direction
    double vibration_angle;  ///< beta, rad, between the direction of vibration and the trough, [0, pi/2)
    double amplitude;        ///< r, m, in the direction of vibration: half the stroke
    double frequency;        ///< 1/T, Hz
    double friction;         ///< mu, grain on trough
    double restitution;      ///< e, grain on trough, nominal value of the contact model
};

/// Spheres in three classes of equal number with diameters 1 - s, 1 and 1 + s times `diameter`.
struct Grains {
    double diameter;         ///< m
    double diameter_spread;  ///< s, 0 for one size
    double density;          ///< kg/m^3
    double youngs_modulus;   ///< Pa, of grain and trough
    double poisson_ratio;
    double friction;          ///< grain on grain
    double restitution;       ///< grain on grain, nominal
    double rolling_friction;  ///< coefficient of the epsd2 model; 0 switches the model off
};

/// A piece of an endless layer: periodic along and across the trough. One of `height` and `grains` was
/// given; `grains` is always set.
struct Layer {
    double length;                 ///< m, along x
    double width;                  ///< m, along y
    std::optional<double> height;  ///< m, at rest, as asked for
    int grains;                    ///< number of grains
};

struct MeasurementPlan {
    int packings;       ///< independent packings per case
    double confidence;  ///< of every interval, e.g. 0.95
    double half_width;  ///< of velocity efficiency, wanted of each packing
    int max_cycles;     ///< per packing
};

struct OutputPlan {
    int frames_per_cycle;  ///< of the first packing; 0 writes none
};

/// One validated case. SI units throughout.
struct Scenario {
    std::string campaign;  ///< name of the campaign: letters, digits, '.', '_', '-'
    Trough trough;
    Grains grains;
    Layer layer;
    MeasurementPlan measure;
    OutputPlan output;
};

double angular_frequency(Trough const& trough);  ///< omega, rad/s
double machine_number(Trough const& trough);     ///< K = omega^2 r / g
double throw_number(Trough const& trough);       ///< Gamma = omega^2 r sin(beta) / (g cos(alpha))

/// omega r cos(beta), m/s: what one unit of velocity efficiency is worth.
double velocity_scale(Trough const& trough);

/// The case as a campaign file of its own, in SI units with 17 digits: the same scenario always gives the
/// same text, and reading the text gives the same scenario.
std::string to_toml(Scenario const& scenario);

}  // namespace vibrotrough
