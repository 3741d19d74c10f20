#pragma once

#include "measure/layer_motion.hpp"

#include <optional>

namespace vibrotrough::measure {

/// What a layer does to the machine that carries it, from its force on the trough in phase with the motion.
///
/// The first harmonics of force F and velocity V of the trough are complex vectors (along, normal). Their
/// ratio Z = -F . conj(V) / |V|^2 = c + i omega m_a is the impedance of a mass m_a that is fixed to the
/// trough, and of a damper c to the ground. On a trough that vibrates along a line this is the force in the
/// direction of vibration. Springs see the machine's mass plus m_a, so that a sprung trough is detuned by it;
/// m_a may be negative.
struct Reaction {
    double added_mass;  ///< m_a, kg
    double damping;     ///< c, kg/s = N s/m
    double power;       ///< W, of the trough on the layer, all harmonics; c |V|^2 / 2 is that of the first
};

/// The reaction of a layer whose mean curves over a period are known; none without curves and for a trough
/// that does not move. The force of an interval of a hundredth of a cycle is its mean, for which the first
/// harmonic is corrected exactly and the power to 0.1 %.
/// @param frequency  of the drive, Hz
std::optional<Reaction> layer_reaction(PhaseCurves const& curves, double frequency);

/// Sets added_mass, damping and trough_power of a motion from its curves.
void add_reaction(LayerMotion& motion, double frequency);

}  // namespace vibrotrough::measure
