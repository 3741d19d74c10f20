#pragma once

#include <string>

// Friction from a horizontal shake test (Sloot & Kruyt 1996, Section 6 and Fig. 8): a box of grains slides on
// a plate that is shaken horizontally, beta = 0; the largest displacement of the box against the plate tells
// mu.
namespace vibrotrough::theory {

/// A shake test: beta = 0, so the throw number is zero and only K acts.
struct ShakeTest {
    double machine_number;       ///< K = omega^2 r / g, in [1e-3, 1e4]
    double tan_inclination = 0;  ///< of the plate along the shaking
};

/// The motion of a mass on a plate that is shaken.
struct ShakeMotion {
    double max_relative_displacement;  ///< largest way of one slide against the plate, in amplitudes r; in
                                       ///< [0, 2)
    std::string mode;                  ///< letters of the phases in order, e.g. "PN"
};

/// The forward curve of Fig. 8 (Eq. 10 with Eq. 20 in the PN mode, the solver elsewhere). mu > |tan(alpha)|.
/// Falls with mu from 2 (mu = 0: the box stands still in space) to 0 at mu = K.
ShakeMotion shake(ShakeTest const& test, double friction);

/// The friction that explains a measured displacement.
struct FrictionEstimate {
    double friction;   ///< mu
    double low, high;  ///< for the displacement plus and minus its uncertainty
    std::string
        mode;  ///< at `friction`: outside PN the mass rests between slides and static friction matters
};

/// mu from the measured displacement X with its uncertainty, by a bracketed root of the forward curve, which
/// is monotone.
/// @param displacement  X in amplitudes, in (0, 2)
/// @param uncertainty   of X, >= 0; the interval of mu is where X - uncertainty and X + uncertainty are
/// @throws std::invalid_argument when no mu gives this displacement
FrictionEstimate friction_from_shake(ShakeTest const& test, double displacement, double uncertainty);

}  // namespace vibrotrough::theory
