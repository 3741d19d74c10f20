#pragma once

#include "theory/point_mass.hpp"

#include <cstdint>
#include <memory>
#include <string>

namespace vibrotrough::theory {

/// The phases of a mode in order, three bits each: what a map stores for a mode. 0 is no mode.
using ModeCode = std::uint64_t;

/// "FPN" and the like; "" for 0. A mode of more than 21 phases ends with "..".
std::string to_string(ModeCode code);

/// Appends a phase to a code of `length` phases.
ModeCode with_phase(ModeCode code, PhaseKind kind, int length);

/// What is asked of very many points.
struct Efficiency {
    double velocity_efficiency;  ///< eta, as in Motion; error below 1e-9
    ModeCode mode;               ///< phases of one period; 0 when the motion does not settle
    int period_cycles;           ///< cycles after which the motion repeats; 0 when it does not settle
    Outcome outcome;             ///< how the long run ends
};

/// Solves many plastic point masses (see solve()) in a row, fast: it keeps what neighbouring points share,
/// the flight of the last throw number and the last periodic motion as first guess. Guesses change the cost
/// and never the answer beyond the stated error: every root is still bracketed.
///
/// One solver serves one thread. Cheapest when the throw number changes slowest.
class EfficiencySolver {
  public:
    EfficiencySolver();
    ~EfficiencySolver();
    /// Moves the memory of earlier points.
    EfficiencySolver(EfficiencySolver&&) noexcept;
    /// Moves the memory of earlier points.
    EfficiencySolver& operator=(EfficiencySolver&&) noexcept;

    /// @throws std::invalid_argument, PhaseError as solve() does
    Efficiency operator()(PointMass const& input);

  private:
    struct Memory;
    std::unique_ptr<Memory> memory_;
};

}  // namespace vibrotrough::theory
