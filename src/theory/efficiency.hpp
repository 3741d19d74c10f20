#pragma once

#include "theory/point_mass.hpp"

#include <cstdint>
#include <memory>
#include <string>

namespace vibrotrough::theory {

struct Conveyor;  // see conveyor.hpp

/// The phases of a mode in order, three bits per phase, as stored in a map. 0 means that there is no mode.
using ModeCode = std::uint64_t;

/// The letters of the mode, e.g. "FPN"; "" for 0. A mode of more than 21 phases is cut and ends with "..".
std::string to_string(ModeCode code);

/// Appends a phase to the code of a mode that has `length` phases so far.
ModeCode append_phase(ModeCode code, PhaseKind kind, int length);

/// The code of the mode of a motion.
ModeCode mode_code(Motion const& motion);

/// The result for one point of many.
struct Efficiency {
    double velocity_efficiency;  ///< eta, as in Motion; error below 1e-9
    ModeCode mode;               ///< phases of one period; 0 when the motion does not settle
    int period_cycles;           ///< cycles after which the motion repeats; 0 when it does not settle
    Outcome outcome;             ///< how the long run ends
    double half_width = 0;       ///< of the 95 % confidence interval of eta if no period was found
};

/// Solves many point masses or conveyors (see solve()) one after another, fast. It reuses the flights while
/// only other inputs change. What was solved before does not change a bit of an answer.
///
/// Use one solver per thread. It is fastest when the throw number is the outermost loop.
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
    /// The same for the general model. @throws std::invalid_argument, PhaseError as solve(Conveyor) does
    Efficiency solve(Conveyor const& input);

  private:
    struct Memory;
    std::unique_ptr<Memory> memory_;
};

}  // namespace vibrotrough::theory
