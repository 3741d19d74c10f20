#include "learn/driven_design.hpp"

#include <cmath>
#include <stdexcept>

namespace vibrotrough::learn {
namespace {

constexpr int most_repetitions = 12;
constexpr double same_stroke = 1e-3;  // relative

}  // namespace

double material_on(DesignTask const& task, double depth) {
    return task.bulk_density * task.width * task.length * depth;
}

ChosenDesign design_with_exciter(DesignTask const& task,
                                 std::function<ChosenDesign(DesignTask const&)> const& find) {
    MovedMachine const& machine = *task.machine;
    DesignTask one = task;
    double depth = 0;
    for (int i = 0; i < most_repetitions; ++i) {
        double const material = material_on(task, depth);
        double const amplitude = amplitude_of(machine, task.space.frequency.low, material);
        one.space.amplitude = {amplitude, amplitude};
        double const by_mass = amplitude * machine.added_mass.sd * material / machine.moving_mass(material);
        one.errors.amplitude = std::hypot(task.errors.amplitude, by_mass);
        ChosenDesign found = find(one);
        depth = found.design.depth;
        double const under_it = amplitude_of(machine, task.space.frequency.low, material_on(task, depth));
        if (std::abs(under_it / amplitude - 1) < same_stroke) return found;
    }
    throw std::invalid_argument(
        "the stroke and the depth of the layer change each other without an end; give the stroke by "
        "--stroke");
}

}  // namespace vibrotrough::learn
