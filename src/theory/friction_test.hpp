#pragma once

#include <optional>
#include <string>

// The friction coefficient from a horizontal shake test (Sloot & Kruyt 1996, section 3.5 and Fig. 8): a box
// of grains slides on a plate that is shaken horizontally (beta = 0), and mu follows from the largest
// displacement of the box relative to the plate.
namespace vibrotrough::theory {

/// A shake test. As beta = 0, the throw number is zero and the machine number K describes the drive.
struct ShakeTest {
    double machine_number;       ///< K = omega^2 r / g, in [1e-3, 1e4]
    double tan_inclination = 0;  ///< tan(alpha) of the plate in the direction of shaking
};

/// The motion of a mass on a plate that is shaken.
struct ShakeMotion {
    double max_relative_displacement;  ///< largest displacement relative to the plate in one slide, in
                                       ///< amplitudes r; in [0, 2) on a level plate
    std::string mode;                  ///< letters of the phases in order, e.g. "PN"
};

/// The displacement as a function of friction, as in Fig. 8 (Eq. 10 with Eq. 20 in the PN mode, the solver
/// elsewhere), for mu > |tan(alpha)|. On a level plate it decreases with mu from 2 (at mu = 0 the box does
/// not move in space) to 0 at mu = K.
ShakeMotion shake(ShakeTest const& test, double friction);

/// The mass rests within the cycle, so that static friction acts on the result: the mode is not PN.
bool rests_within_cycle(std::string const& mode);

/// The friction that explains a measured displacement.
struct FrictionEstimate {
    double friction;  ///< mu
    double low;       ///< for the displacement plus its uncertainty
    /// For the displacement minus its uncertainty; none where that is not above 0, because every mu from K on
    /// has no slip.
    std::optional<double> high;
    std::string mode;  ///< at `friction`; in modes other than PN the mass rests between slides and static
                       ///< friction matters
};

/// The friction coefficient from the measured displacement X and its uncertainty, as a bracketed root of
/// shake(), which is monotone in mu.
/// @param displacement  X in amplitudes, above 0, and on a level plate below 2
/// @param uncertainty   of X, >= 0; the interval of mu is that of X - uncertainty to X + uncertainty
/// @throws std::invalid_argument when no friction coefficient gives this displacement
FrictionEstimate friction_from_shake(ShakeTest const& test, double displacement, double uncertainty);

}  // namespace vibrotrough::theory
