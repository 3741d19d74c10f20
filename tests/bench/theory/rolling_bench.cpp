#include "theory/rolling_layer.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <numbers>
#include <random>
#include <vector>

// Time per solution of the rolling-layer law within its tested range, point by point; the median is hardly
// changed by other work on the machine. With an argument the efficiencies are printed, too, to compare two
// programs.
namespace vibrotrough::theory {
namespace {

constexpr int count = 60;

PointMass map_point(double x, double y, double inclination, double friction) {
    double const angle = (15 + 29 * y) * std::numbers::pi / 180;
    return {1.25 + 1.35 * x, std::tan(angle), inclination, friction};
}

/// Maps of throw number and vibration angle, line by line as theory map solves them.
std::vector<PointMass> map_points(double inclination, double friction) {
    std::vector<PointMass> points;
    for (int i = 0; i < count; ++i)
        for (int j = 0; j < count; ++j)
            points.push_back(map_point(i / (count - 1.0), j / (count - 1.0), inclination, friction));
    return points;
}

std::vector<PointMass> unrelated_points() {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<> unit(0, 1);
    std::vector<PointMass> points;
    for (int i = 0; i < count * count; ++i) {
        double const x = unit(random), y = unit(random), slope = 0.16 * unit(random) - 0.08;
        points.push_back(map_point(x, y, slope, 0.1 + 0.5 * unit(random)));
    }
    return points;
}

void time(char const* name, std::vector<PointMass> const& points, bool print) {
    using Clock = std::chrono::steady_clock;
    RollingLayerSolver solver{RollingLaw{}};
    std::vector<double> took;
    std::clock_t const begin = std::clock();
    for (PointMass const& point : points) {
        auto const start = Clock::now();
        double const efficiency = solver(point).motion.velocity_efficiency;
        took.push_back(std::chrono::duration<double, std::micro>(Clock::now() - start).count());
        if (print) std::printf("%.15g\n", efficiency);
    }
    double const cpu = 1e6 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    std::sort(took.begin(), took.end());
    std::fprintf(stderr, "%-34s median %6.2f  90 %% %6.2f  mean of CPU time %6.2f microseconds\n", name,
                 took[took.size() / 2], took[took.size() * 9 / 10], cpu / static_cast<double>(took.size()));
}

}  // namespace
}  // namespace vibrotrough::theory

int main(int argc, char**) {
    using namespace vibrotrough::theory;
    bool const print = argc > 1;
    time("map, level, mu 0.23", map_points(0, 0.23), print);
    time("map, uphill 0.05, mu 0.35", map_points(0.05, 0.35), print);
    time("map, downhill 0.08, mu 0.5", map_points(-0.08, 0.5), print);
    time("unrelated points", unrelated_points(), print);
}
