#include "learn/machine_keys.hpp"

#include "scenario/model/scenario.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <variant>

namespace vibrotrough::learn {

scenario::Key const* machine_key(std::string_view path) {
    scenario::Key const* const key = scenario::find_key(path);
    bool const is_of_machine = key != nullptr && section_of(*key) == "trough" && !key->group.empty();
    return is_of_machine ? key : nullptr;
}

theory::PointMass point_of(theory::Drive const& drive, double friction) {
    return {std::clamp(drive.throw_number(), 1e-6, theory::largest_throw_number),
            std::tan(drive.vibration_angle), std::tan(drive.inclination), friction};
}

double value_at(scenario::Key const& key, theory::Drive const& drive) {
    // On the heap, because GCC 12 warns of texts on the stack that it takes for uninitialized.
    auto const made = std::make_unique<scenario::Scenario>();
    scenario::Scenario& machine = *made;
    machine.trough.inclination = drive.inclination;
    machine.trough.vibration_angle = drive.vibration_angle;
    machine.trough.amplitude = drive.amplitude;
    machine.trough.frequency = drive.frequency;
    return std::get<double>(*key.get(machine));
}

}  // namespace vibrotrough::learn
