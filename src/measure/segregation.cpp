#include "measure/segregation.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

namespace vibrotrough::measure {

std::vector<double> segregation_index(std::span<MaterialSeries const> materials,
                                      std::span<double const> masses, std::size_t which, double height) {
    std::vector<double> index;
    for (std::size_t k = 0; k < materials[which].z.size(); ++k) {
        double moment = 0, mass = 0;
        for (std::size_t i = 0; i < materials.size(); ++i) {
            if (i == which) continue;
            moment += masses[i] * materials[i].z[k];
            mass += masses[i];
        }
        index.push_back((materials[which].z[k] - moment / mass) / (height / 2));
    }
    return index;
}

int last_cycles(int cycles) {
    return std::max(1, cycles / 10);
}

double material_efficiency(MaterialSeries const& material, int from, double amplitude_x) {
    auto const cycles = static_cast<double>(material.x.size()) - 1 - from;
    if (cycles <= 0) return std::numeric_limits<double>::quiet_NaN();
    double const displacement = material.x.back() - material.x[static_cast<std::size_t>(from)];
    return displacement / (2 * std::numbers::pi * amplitude_x * cycles);
}

}  // namespace vibrotrough::measure
