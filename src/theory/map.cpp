#include "theory/map.hpp"

#include "theory/tested_range.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

namespace vibrotrough::theory {
namespace {

constexpr int bisections = 27;          // of an edge of the grid: to 1e-8 of its length
constexpr int bisections_general = 12;  // for models that cost a thousand times more: to 2e-4 of it

/// A chain of rebounds counts as one flight in a map, because the number of rebounds changes from point to
/// point.
ModeCode with_chains_joined(ModeCode code) {
    ModeCode joined = 0, last = 0;
    int length = 0;
    auto const flight = static_cast<ModeCode>(PhaseKind::flight) + 1;
    for (; code != 0; code >>= 3) {
        ModeCode const letter = code & 7;
        if (letter != flight || last != flight) joined |= letter << (3 * length++);
        last = letter;
    }
    return joined;
}

Inputs at_place(Inputs inputs, Map const& map, double x, double y) {
    inputs.set(map.x.input, x);
    inputs.set(map.y.input, y);
    return inputs;
}

/// A map under construction: its points, and how to solve one of them.
class Grid {
  public:
    Grid(Inputs const& fixed, Map& map) : fixed_(fixed), map_(map) {}

    Efficiency solve(double x, double y, PointSolver& solver) const {
        Inputs const inputs = at_place(fixed_, map_, x, y);
        Efficiency point = solver(inputs);
        if (inputs.get(Input::restitution).value_or(0) > 0) point.mode = with_chains_joined(point.mode);
        return point;
    }
    std::size_t number(int i, int j) const {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(map_.x.count) +
               static_cast<std::size_t>(i);
    }
    Efficiency& at(int i, int j) const { return map_.points[number(i, j)]; }
    void solve_line(int line, bool along_y, int starts, PointSolver& solver) const {
        int const length = along_y ? map_.y.count : map_.x.count;
        MotionSurvey survey;
        for (int k = 0; k < length; ++k) {
            int const i = along_y ? line : k, j = along_y ? k : line;
            double const x = map_.x.value(i), y = map_.y.value(j);
            at(i, j) = solve(x, y, solver);
            if (starts == 0) continue;
            map_.motions[number(i, j)] = survey(at_place(fixed_, map_, x, y).conveyor(), at(i, j), starts);
        }
    }
    struct Crossing {
        double x, y;
        ModeCode mode_a, mode_b;
    };
    /// The crossings of the edges that the next row of cells shares with the last one.
    struct SharedEdges {
        int row = -1;                                             ///< the lower row of these edges' points
        std::vector<std::optional<std::optional<Crossing>>> all;  ///< by column; nothing: not known yet
    };
    void locate_boundaries(int row, PointSolver& solver, SharedEdges& lower,
                           std::vector<BoundaryPiece>& found) const;

  private:
    std::optional<Crossing> crossing(int i0, int j0, int i1, int j1, PointSolver& solver) const;

    Inputs fixed_;
    Map& map_;
};

/// A point on the edge between two nodes where the mode changes.
std::optional<Grid::Crossing> Grid::crossing(int i0, int j0, int i1, int j1, PointSolver& solver) const {
    ModeCode const a = at(i0, j0).mode, b = at(i1, j1).mode;
    if (a == b) return std::nullopt;
    double const x0 = map_.x.value(i0), y0 = map_.y.value(j0), dx = map_.x.value(i1) - x0,
                 dy = map_.y.value(j1) - y0;
    double lo = 0, hi = 1;
    ModeCode beyond = b;
    bool const plastic =
        fixed_.plastic() && !is_beyond_plastic(map_.x.input) && !is_beyond_plastic(map_.y.input);
    for (int n = 0; n < (plastic ? bisections : bisections_general); ++n) {
        double const middle = (lo + hi) / 2;
        ModeCode const mode = solve(x0 + middle * dx, y0 + middle * dy, solver).mode;
        if (mode == a) {
            lo = middle;
        } else {
            hi = middle;
            beyond = mode;
        }
    }
    double const s = (lo + hi) / 2;
    return Crossing{x0 + s * dx, y0 + s * dy, a, beyond};
}

void Grid::locate_boundaries(int j, PointSolver& solver, SharedEdges& lower,
                             std::vector<BoundaryPiece>& found) const {
    auto const columns = static_cast<std::size_t>(map_.x.count);
    if (lower.row != j) lower.all.assign(columns, std::nullopt);
    SharedEdges upper{j + 1, std::vector<std::optional<std::optional<Crossing>>>(columns)};
    std::optional<std::optional<Crossing>> left;  // of this cell, from the one before
    for (int i = 0; i + 1 < map_.x.count; ++i) {
        ModeCode const corner = at(i, j).mode;
        auto const before = std::exchange(left, std::nullopt);
        bool periodic =
            true;  // modes with long periods or none change everywhere: do not draw boundaries there
        for (Efficiency const* p : {&at(i, j), &at(i + 1, j), &at(i, j + 1), &at(i + 1, j + 1)}) {
            periodic = periodic && p->period_cycles >= 1 && p->period_cycles <= 2;
        }
        if (!periodic) continue;
        if (corner == at(i + 1, j).mode && corner == at(i, j + 1).mode && corner == at(i + 1, j + 1).mode)
            continue;
        auto const column = static_cast<std::size_t>(i);
        auto const& below = lower.all[column];
        std::array<std::optional<Crossing>, 4> const edges{
            below ? *below : crossing(i, j, i + 1, j, solver), crossing(i + 1, j, i + 1, j + 1, solver),
            crossing(i, j + 1, i + 1, j + 1, solver), before ? *before : crossing(i, j, i, j + 1, solver)};
        left = edges[1];
        upper.all[column] = edges[2];
        std::vector<Crossing> points;
        for (auto const& edge : edges) {
            if (edge) points.push_back(*edge);
        }
        if (points.size() == 2) {
            found.push_back(
                {points[0].x, points[0].y, points[1].x, points[1].y, points[0].mode_a, points[0].mode_b});
            continue;
        }
        double x = 0, y = 0;  // several modes meet in this cell: connect the crossings to their mean point
        for (Crossing const& p : points) {
            x += p.x / static_cast<double>(points.size());
            y += p.y / static_cast<double>(points.size());
        }
        for (Crossing const& p : points) found.push_back({p.x, p.y, x, y, p.mode_a, p.mode_b});
    }
    lower = std::move(upper);
}

/// What one thread keeps from line to line.
struct Worker {
    PointSolver solver;
    Grid::SharedEdges edges{};
};

template <class Work>
void for_lines(int lines, std::optional<RollingLaw> const& rolling, Work const& work) {
    tbb::parallel_for(tbb::blocked_range<int>(0, lines, 4), [&](tbb::blocked_range<int> const& range) {
        Worker worker{PointSolver(rolling)};
        for (int line = range.begin(); line < range.end(); ++line) work(line, worker);
    });
}

}  // namespace

PointSolver::PointSolver(std::optional<RollingLaw> const& rolling) {
    if (rolling) rolling_.emplace(*rolling);
}

Efficiency PointSolver::operator()(Inputs const& inputs) {
    if (rolling_) {
        if (!inputs.plastic()) {
            throw std::invalid_argument(
                "the rolling-layer law has no restitution, static friction, drag, walls or other drive");
        }
        Motion const m = (*rolling_)(inputs.point()).motion;
        return {m.velocity_efficiency, mode_code(m), m.period_cycles, m.outcome};
    }
    return point_mass_.solve(inputs.conveyor());
}

void check_starts(int starts, std::optional<RollingLaw> const& rolling) {
    if (starts < 0) throw std::invalid_argument("the number of starts is negative");
    if (starts > 0 && rolling)
        throw std::invalid_argument(
            "different starts are followed for a point mass only, not for a rolling layer");
}

namespace {

constexpr Efficiency withheld{std::numeric_limits<double>::quiet_NaN(), 0, 0, Outcome::unsettled,
                              std::numeric_limits<double>::quiet_NaN()};

}  // namespace

std::size_t withhold_untested(std::vector<Inputs> const& inputs, std::vector<Efficiency>& points) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        if (!outside_tested_range(inputs[i].point())) continue;
        points[i] = withheld;
        ++count;
    }
    return count;
}

std::size_t withhold_untested(Inputs const& fixed, Map& map) {
    std::vector<Inputs> places;
    for (int j = 0; j < map.y.count; ++j)
        for (int i = 0; i < map.x.count; ++i)
            places.push_back(at_place(fixed, map, map.x.value(i), map.y.value(j)));
    std::erase_if(map.boundaries, [&](BoundaryPiece const& piece) {
        double const x = (piece.x0 + piece.x1) / 2, y = (piece.y0 + piece.y1) / 2;
        return outside_tested_range(at_place(fixed, map, x, y).point()).has_value();
    });
    return withhold_untested(places, map.points);
}

Map solve_map(Inputs const& fixed, MapAxis const& x, MapAxis const& y, MapOptions const& options) {
    if (x.input == y.input)
        throw std::invalid_argument("both axes of the map are " + std::string(name_of(x.input)));
    for (MapAxis const* axis : {&x, &y}) {
        bool const good =
            axis->count >= 1 && axis->count <= 20000 && std::isfinite(axis->from) && std::isfinite(axis->to);
        if (!good)
            throw std::invalid_argument("a map axis needs 1 to 20000 values between two finite numbers");
        if (fixed.get(axis->input)) {
            throw std::invalid_argument(std::string(name_of(axis->input)) +
                                        " is given both as an axis and as a fixed value");
        }
    }
    static_cast<void>(PointSolver(options.rolling));  // its constants are checked once, not in a thread
    check_starts(options.starts, options.rolling);
    Map map{x, y, {}, {}, {}, 0};
    map.points.resize(static_cast<std::size_t>(x.count) * static_cast<std::size_t>(y.count));
    if (options.starts > 0) map.motions.resize(map.points.size());
    Grid const grid(fixed, map);
    // The solver is fastest when the throw number, which determines the flight, is the outermost loop.
    bool const along_y = x.input == Input::throw_number;
    tbb::task_arena arena(options.jobs > 0 ? options.jobs : tbb::task_arena::automatic);
    std::clock_t const start = std::clock();
    arena.execute([&] {
        for_lines(along_y ? x.count : y.count, options.rolling, [&](int line, Worker& worker) {
            grid.solve_line(line, along_y, options.starts, worker.solver);
        });
    });
    map.cpu_seconds_per_solution =
        static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / static_cast<double>(map.points.size());
    std::vector<std::vector<BoundaryPiece>> found(options.boundaries ? static_cast<std::size_t>(y.count - 1)
                                                                     : 0);
    auto const locate = [&] {
        for_lines(static_cast<int>(found.size()), options.rolling, [&](int line, Worker& worker) {
            grid.locate_boundaries(line, worker.solver, worker.edges, found[static_cast<std::size_t>(line)]);
        });
    };
    auto const use_points = [&] {
        if (options.with_points) options.with_points(map);
    };
    arena.execute([&] { tbb::parallel_invoke(use_points, locate); });
    for (auto const& row : found) map.boundaries.insert(map.boundaries.end(), row.begin(), row.end());
    return map;
}

std::size_t count_modes(Map const& map) {
    std::set<ModeCode> modes;
    ModeCode last = ~ModeCode{0};  // neighbours mostly have the same mode
    for (Efficiency const& point : map.points) {
        if (point.mode != last) modes.insert(point.mode);
        last = point.mode;
    }
    return modes.size();
}

}  // namespace vibrotrough::theory
