#pragma once

#include "theory/coexisting.hpp"
#include "theory/efficiency.hpp"
#include "theory/inputs.hpp"
#include "theory/rolling_layer.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::theory {

/// One axis of a map: `count` equally spaced values of an input between `from` and `to`, both included.
struct MapAxis {
    Input input;      ///< what the axis varies
    double from, to;  ///< first and last value, in the unit of the input
    int count;        ///< number of values, >= 1
    /// The value at index i in [0, count).
    double value(int i) const { return count < 2 ? from : from + (to - from) * i / (count - 1); }
};

/// A segment of the boundary between two modes within one cell of the map; its end points are roots, known to
/// 1e-8 of a cell.
struct BoundaryPiece {
    double x0, y0, x1, y1;    ///< its two ends, in the units of the axes
    ModeCode mode_a, mode_b;  ///< the modes on its two sides
};

/// Velocity efficiency and mode over a grid of two inputs.
struct Map {
    MapAxis x, y;                    ///< the two inputs
    std::vector<Efficiency> points;  ///< points[j * x.count + i]
    /// The motions of each point to which different starts lead; empty when not asked for.
    std::vector<std::vector<CoexistingMotion>> motions;
    std::vector<BoundaryPiece> boundaries;  ///< boundaries between modes; empty unless requested
    double cpu_seconds_per_solution;  ///< CPU time of all threads divided by the number of points, without
                                      ///< the boundaries
};

/// How a map is computed.
struct MapOptions {
    int jobs = 0;                            ///< threads; 0: all cores
    int starts = 0;                          ///< for a MotionSurvey of each point; 0: none
    bool boundaries = true;                  ///< whether to locate the boundaries between modes
    std::optional<RollingLaw> rolling = {};  ///< solves rolling layers with this law instead of point masses
    /// Is called once, when all points are there and while the boundaries are still being located, in one of
    /// the threads: what is done with the points need not wait. It may read all of the map but `boundaries`.
    std::function<void(Map const&)> with_points = {};
};

/// Velocity efficiency and mode on a grid of two inputs with the others fixed (Figs 2-5 of the paper).
///
/// Point masses and conveyors are solved by EfficiencySolver. The boundary between two modes is located by
/// bisection along every edge of the grid whose end points differ in mode, to 1e-8 of the edge (2e-4 for
/// models other than the plastic point mass), if the period is one or two cycles. A chain of rebounds counts
/// as one flight in a map.
///
/// @throws std::invalid_argument when the inputs are incomplete, an axis is also given as a fixed input, or a
/// value is out of range, also one of the law; PhaseError when a point cannot be solved
Map solve_map(Inputs const& fixed, MapAxis const& x, MapAxis const& y, MapOptions const& options);

/// How many different modes the points of a map have.
std::size_t count_modes(Map const& map);

/// Solves points as in a map, for any inputs, one after another. Use one per thread.
class PointSolver {
  public:
    /// @param rolling  the law of rolling layers; nothing: point masses
    /// @throws std::invalid_argument when a constant of the law is out of range
    explicit PointSolver(std::optional<RollingLaw> const& rolling = {});

    /// @throws std::invalid_argument when the inputs are incomplete, out of range, or extend the point mass
    /// of a rolling layer; PhaseError when the point cannot be solved
    Efficiency operator()(Inputs const& inputs);

  private:
    EfficiencySolver point_mass_;
    std::optional<RollingLayerSolver> rolling_;
};

/// @throws std::invalid_argument for a negative number of starts, and for starts with a law: a survey is of
/// point masses
void check_starts(int starts, std::optional<RollingLaw> const& rolling);

/// Replaces the efficiencies at which the rolling-layer law has not been tested by NaN, and the modes by
/// none.
/// @return how many points these are
std::size_t withhold_untested(std::vector<Inputs> const& inputs, std::vector<Efficiency>& points);

/// The same for the points of a map, whose boundaries outside the tested range are removed.
std::size_t withhold_untested(Inputs const& fixed, Map& map);

}  // namespace vibrotrough::theory
