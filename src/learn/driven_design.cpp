#include "learn/driven_design.hpp"

#include "atlas/unknown.hpp"

#include <cmath>
#include <stdexcept>

namespace vibrotrough::learn {
namespace {

constexpr int most_repetitions = 12;
constexpr double same_stroke = 1e-3;  // relative

Uncertain uncertain(atlas::Bounded const& number) {
    return {number.value, number.half_width / atlas::deviations_in_half_width};
}

}  // namespace

double material_on(DesignTask const& task, double depth) {
    return task.bulk_density * task.width * task.length * depth;
}

std::optional<atlas::LayerLoad> load_of(DesignTask const& task, RiskDesign const& design) {
    if (!task.grain_diameter) return {};
    theory::Drive const& drive = design.drive;
    atlas::Place const place = atlas::PartlyKnown::place_of(
        {design.throw_number, std::tan(drive.vibration_angle), std::tan(drive.inclination),
         task.friction.median, drive.amplitude / *task.grain_diameter, design.depth / *task.grain_diameter,
         std::nullopt, task.rolling_friction, std::nullopt});
    if (!atlas::outside_ranges(place).empty()) return {};
    return atlas::load_at(place);
}

void settle_load(DesignTask& task, RiskDesign const& design) {
    if (!task.machine) return;
    MovedMachine& machine = *task.machine;
    auto const load = load_of(task, design);
    machine.damping.reset();
    if (load) machine.damping = uncertain(load->damping);
    if (machine.added_mass_source == AddedMassSource::given) return;
    machine.added_mass = load ? uncertain(load->added_mass) : MovedMachine{}.added_mass;
    machine.added_mass_source = load ? AddedMassSource::atlas : AddedMassSource::maker;
}

ChosenDesign design_with_exciter(DesignTask const& task,
                                 std::function<ChosenDesign(DesignTask const&)> const& find) {
    DesignTask one = task;
    MovedMachine& machine = *one.machine;
    double depth = 0;
    for (int i = 0; i < most_repetitions; ++i) {
        double const material = material_on(task, depth);
        double const amplitude = amplitude_of(machine, task.space.frequency.low, material);
        one.space.amplitude = {amplitude, amplitude};
        double const by_load = amplitude_sd(machine, task.space.frequency.low, material);
        one.errors.amplitude = std::hypot(task.errors.amplitude, by_load);
        ChosenDesign found = find(one);
        settle_load(found.task, found.design);
        machine = *found.task.machine;
        depth = found.design.depth;
        double const under_it = amplitude_of(machine, task.space.frequency.low, material_on(task, depth));
        if (std::abs(under_it / amplitude - 1) < same_stroke) return found;
    }
    throw std::invalid_argument(
        "the stroke and the depth of the layer change each other without an end; give the stroke by "
        "--stroke");
}

}  // namespace vibrotrough::learn
