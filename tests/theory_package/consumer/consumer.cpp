#include <cstdio>

#include <theory/map.hpp>
#include <theory/point_mass.hpp>

int main() {
    namespace theory = vibrotrough::theory;
    std::printf("%.6f\n", theory::solve(theory::PointMass{2, 0.5, 0, 0.23}).velocity_efficiency);
}
