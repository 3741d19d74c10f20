#pragma once

#include "theory/detail/rolling/phase_sum.hpp"
#include "theory/rolling_layer.hpp"

#include <vector>

// The normal motion of a rolling layer. Internal to this module.
namespace vibrotrough::theory::detail {

/// A part of the normal motion in which the layer touches the trough all the time, or flies all the time.
struct NormalPiece {
    double start, end;   ///< rad
    bool contact;        ///< whether the trough exerts a force
    double impulse = 0;  ///< of a rigid landing at the start, omega r sin(beta) per mass
    PhaseBasis basis{};  ///< of the sums
    PhaseSum gap{};      ///< r sin(beta)
    PhaseSum force{};    ///< n
};

/// One period of the normal motion.
struct RollingNormal {
    std::vector<NormalPiece> pieces;  ///< starting at a take-off, if there is one
    int cycles = 1;  ///< of the period; 0 when none was found: the last 200 cycles are then kept
};

/// The normal motion of a law at a throw number.
RollingNormal find_rolling_normal(double throw_number, RollingLaw const& law);

/// The rates of the two decays of a soft landing.
std::array<double, 2> landing_rates(RollingLaw const& law);

}  // namespace vibrotrough::theory::detail
