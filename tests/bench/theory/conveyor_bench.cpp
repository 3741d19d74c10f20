// Prints a table: CPU time per point of EfficiencySolver, of solve(Conveyor) and of CVODE, for each extension
// of the point mass. Run by compare.py, which adds scipy.

#include "cvode_conveyor.hpp"
#include "theory/conveyor.hpp"
#include "theory/efficiency.hpp"
#include "theory/rolling_layer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <numbers>
#include <string>
#include <vector>

namespace vibrotrough::theory {
namespace {

struct Model {
    char const* name;
    void (*extend)(Conveyor&);
    bool simple;  ///< whether the other integrators describe it
};

Model const models[] = {
    {"plastic sine", [](Conveyor&) {}, true},
    {"ellipse", [](Conveyor& c) { c.along_phase = 20 * std::numbers::pi / 180; }, true},
    {"harmonics",
     [](Conveyor& c) {
         c.along = {{2, 0.3, 0.4}};
         c.normal = {{3, 0.2, 1.0}};
     },
     false},
    {"static friction", [](Conveyor& c) { c.static_friction = 0.5; }, true},
    {"air drag", [](Conveyor& c) { c.air_drag = 0.1; }, true},
    {"landing friction", [](Conveyor& c) { c.landing_friction = 0.2; }, true},
    {"side walls",
     [](Conveyor& c) {
         c.wall_friction = 0.3;
         c.height_over_width = 0.5;
     },
     false},
    {"all of these",
     [](Conveyor& c) {
         for (int i : {1, 2, 3, 4, 5, 6}) models[i].extend(c);
     },
     false},
    {"restitution 0.2", [](Conveyor& c) { c.restitution = 0.2; }, false},
    {"restitution 0.5", [](Conveyor& c) { c.restitution = 0.5; }, false},
};

/// The map of the speed claim: Gamma 0.3 to 3.3, beta 5 to 60 degrees, mu 0.35, tan(alpha) -0.10.
std::vector<Conveyor> map_of(Model const& model, int n) {
    std::vector<Conveyor> points;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            Conveyor c{};
            double const beta = (5 + 55.0 * j / (n - 1)) * std::numbers::pi / 180;
            c.point = {0.3 + 3.0 * i / (n - 1), std::tan(beta), -0.1, 0.35};
            model.extend(c);
            points.push_back(c);
        }
    }
    return points;
}

double cpu_time() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Microseconds per point: the median over the points, each the fastest of `repeats`, and the mean.
struct Cost {
    double median, mean;
};

template <class Points, class Solve>
Cost cost(Points const& points, int repeats, Solve const& solve) {
    double clock = 1;  // what reading the clock takes
    for (int i = 0; i < 1000; ++i) {
        double const start = cpu_time();
        clock = std::min(clock, cpu_time() - start);
    }
    std::vector<double> best(points.size(), 1e9);
    for (int r = 0; r < repeats; ++r) {
        for (std::size_t i = 0; i < points.size(); ++i) {
            double const start = cpu_time();
            solve(points[i]);
            best[i] = std::min(best[i], 1e6 * (cpu_time() - start - clock));
        }
    }
    double sum = 0;
    for (double const b : best) sum += b;
    std::sort(best.begin(), best.end());
    return {best[best.size() / 2], sum / static_cast<double>(best.size())};
}

void print(Model const& model, bool with_cvode) {
    EfficiencySolver solver;
    auto const points = map_of(model, 100), some = map_of(model, 20), few = map_of(model, 5);
    Cost const fast = cost(points, 3, [&](Conveyor const& c) { solver.solve(c); });
    Cost const alone = cost(some, 1, [](Conveyor const& c) { solve(c); });
    std::printf("%-16s %9.2f %9.2f %9.1f", model.name, fast.median, fast.mean, alone.median);
    if (model.simple && with_cvode) {
        double worst = 0;
        Cost const cvode = cost(few, 1, [&](Conveyor const& c) {
            double const eta = efficiency_by_cvode(c);
            worst = std::max(worst, std::abs(eta - solver.solve(c).velocity_efficiency));
        });
        std::printf(" %10.0f %9.0f %9.1e", cvode.median, cvode.median / fast.median, worst);
    }
    std::printf("\n");
    std::fflush(stdout);
}

void print_rolling() {
    std::vector<PointMass> points;
    for (Conveyor const& c : map_of(models[0], 100)) {
        PointMass p = c.point;
        p.throw_number = 1.25 + (p.throw_number - 0.3) * 1.35 / 3;
        p.tan_vibration_angle = std::tan(std::atan(p.tan_vibration_angle) * 0.54 + 0.2);
        points.push_back(p);
    }
    RollingLayerSolver solver{RollingLaw{}};
    Cost const fast = cost(points, 3, [&](PointMass const& p) { solver(p); });
    std::printf("%-16s %9.2f %9.2f\n", "rolling layer", fast.median, fast.mean);
}

}  // namespace
}  // namespace vibrotrough::theory

int main(int argc, char** argv) {
    using namespace vibrotrough::theory;
    std::string const argument = argc > 1 ? argv[1] : "";
    std::printf(
        "CPU time per point in microseconds, on a 100 x 100 map (alone, with its phases: 20 x 20, CVODE: 5 x "
        "5)\n");
    std::printf("%-16s %9s %9s %9s %10s %9s %9s\n", "model", "median", "mean", "alone", "CVODE", "ratio",
                "differ by");
    for (Model const& model : models) print(model, argument != "--no-cvode");
    print_rolling();
}
