#include "theory/efficiency.hpp"
#include "theory/point_mass.hpp"

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

namespace vibrotrough::theory {
namespace {

constexpr double degree = std::numbers::pi / 180;

enum class Order { throw_number_slowest, throw_number_fastest };

/// The map of the speed claim: Gamma 0.3 to 3.3, beta 5 to 60 degrees, mu 0.35, tan(alpha) -0.10.
std::vector<PointMass> map_points(Order order) {
    int const n = 500;
    std::vector<PointMass> points;
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            int const x = order == Order::throw_number_slowest ? j : i, y = i + j - x;
            points.push_back(
                {0.3 + 3.0 * x / (n - 1), std::tan((5 + 55.0 * y / (n - 1)) * degree), -0.1, 0.35});
        }
    }
    return points;
}

std::vector<PointMass> unrelated_points() {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<> unit(0, 1);
    std::vector<PointMass> points;
    for (int i = 0; i < 100000; ++i) {
        double const mu = 0.1 + 0.6 * unit(random);
        points.push_back({0.3 + 3 * unit(random), std::tan((5 + 55 * unit(random)) * degree),
                          (2 * unit(random) - 1) * 0.8 * mu, mu});
    }
    return points;
}

void solve_all(benchmark::State& state, std::vector<PointMass> const& points) {
    for (auto _ : state) {
        EfficiencySolver solver;
        for (PointMass const& point : points) benchmark::DoNotOptimize(solver(point));
    }
    state.counters["per_solution"] =
        benchmark::Counter(static_cast<double>(points.size()),
                           benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void map_by_columns(benchmark::State& state) {
    solve_all(state, map_points(Order::throw_number_slowest));
}
void map_by_rows(benchmark::State& state) {
    solve_all(state, map_points(Order::throw_number_fastest));
}
void unrelated(benchmark::State& state) {
    solve_all(state, unrelated_points());
}

BENCHMARK(map_by_columns)->Unit(benchmark::kMillisecond);
BENCHMARK(map_by_rows)->Unit(benchmark::kMillisecond);
BENCHMARK(unrelated)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace vibrotrough::theory

BENCHMARK_MAIN();
