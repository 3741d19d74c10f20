#pragma once

#include "theory/efficiency.hpp"
#include "theory/inputs.hpp"

#include <string>
#include <vector>

namespace vibrotrough::theory {

/// One axis of a map: `count` values of an input at equal steps from `from` to `to`.
struct MapAxis {
    Input input;
    double from, to;
    int count;
    double value(int i) const { return count < 2 ? from : from + (to - from) * i / (count - 1); }
};

struct MapPoint {
    double velocity_efficiency;
    double half_width;  ///< 0 when periodic
    ModeCode mode;
    int period_cycles;
    Outcome outcome;
};

/// A piece of the line between two modes, within one cell of the map; its ends are roots, known to 1e-9 of a
/// cell.
struct BoundaryPiece {
    double x0, y0, x1, y1;
    ModeCode mode_a, mode_b;
};

struct Map {
    MapAxis x, y;
    std::vector<MapPoint> points;           ///< points[j * x.count + i]
    std::vector<BoundaryPiece> boundaries;  ///< where modes meet; empty unless asked for
    double cpu_seconds_per_solution;  ///< CPU time of all threads over the number of points, boundaries apart
};

struct MapOptions {
    int jobs = 0;            ///< threads; 0: all cores
    bool boundaries = true;  ///< locate the lines between modes
};

/// Velocity efficiency and mode over a grid of two inputs, the others fixed (Figs 2-5 of the paper).
///
/// The plastic point mass goes through EfficiencySolver, anything else through solve(Conveyor), which costs a
/// hundred to a thousand times more. The line between two modes is located by bisection along every edge of
/// the grid whose ends differ in mode, to 1e-9 of the edge (2e-4 beyond the plastic point mass), where the
/// period is one or two cycles. A chain of rebounds counts as one flight in a map.
///
/// @throws std::invalid_argument when the inputs are not complete, an axis names what is given twice, or a
/// value is out of its range; PhaseError when a point cannot be solved
Map solve_map(Inputs const& fixed, MapAxis const& x, MapAxis const& y, MapOptions const& options);

/// How many different modes the points of a map have.
std::size_t count_modes(Map const& map);

/// One point as in a map, for any inputs. `solver` is used for the plastic point mass.
MapPoint solve_inputs(Inputs const& inputs, EfficiencySolver& solver);

}  // namespace vibrotrough::theory
