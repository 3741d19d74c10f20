#pragma once

#include "theory/rolling_layer.hpp"

#include <array>
#include <vector>

// The normal motion of a rolling layer. Internal to this room.
namespace vibrotrough::theory::detail {

/// amplitude exp(-rate (t - start))
struct Decay {
    double amplitude = 0, rate = 1;
};

/// constant + sine sin t + cosine cos t + two decays that begin at `start`.
struct ContactForce {
    double constant = 0, sine = 0, cosine = 0;
    std::array<Decay, 2> decays{};
    double start = 0;

    double operator()(double t) const;
    /// The same force with its decays counted from t.
    ContactForce from(double t) const;
    ContactForce scaled(double factor) const;
};

/// A part of the normal motion in which the layer touches the trough all the time, or flies all the time.
struct NormalPiece {
    double start, end;     ///< rad
    bool contact;          ///< whether the trough exerts a force
    double gap, gap_rate;  ///< at the start
    double impulse = 0;    ///< of a rigid landing at the start, omega r sin(beta) per mass
    ContactForce force{};  ///< n
};

/// One period of the normal motion.
struct RollingNormal {
    std::vector<NormalPiece> pieces;  ///< starting at a take-off, if there is one
    int cycles = 1;  ///< of the period; 0 when none was found: the last 200 cycles are then kept
};

/// The normal motion of a law at a throw number.
RollingNormal find_rolling_normal(double throw_number, RollingLaw const& law);

/// Gap and its rate within a piece. @param throw_number, law  those of the motion
std::array<double, 2> gap_at(NormalPiece const& piece, double t, double throw_number, RollingLaw const& law);

}  // namespace vibrotrough::theory::detail
