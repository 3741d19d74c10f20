#include "learn/driven_design.hpp"

#include "atlas/tables.hpp"
#include "atlas/value.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

namespace vibrotrough::learn {
namespace {

constexpr int most_repetitions = 12;
constexpr double same_stroke = 2e-3;  // relative: a layer is rounded up to 0.1 mm, which moves it by so much
constexpr double steepest = 0.8;      // slope of a curve by which a step is lengthened

Uncertain uncertain(atlas::Bounded const& number) {
    return {number.value, number.half_width / atlas::deviations_in_half_width};
}

/// kg, of the material on the trough, roughly: layers move at about half of the trough's largest speed.
double material_guessed(DesignTask const& task) {
    double const frequency = task.space.frequency.low;
    double const trough_speed = 2 * std::numbers::pi * frequency * amplitude_of(*task.machine, frequency, 0);
    double const depth = task.mass_flow / (task.bulk_density * task.width * trough_speed / 2);
    return material_on(task, std::clamp(depth, task.depth.low, task.depth.high));
}

/// The stroke to try next. Under a heavy layer the stroke that the exciter gives approaches its end in many
/// small steps, since a smaller stroke makes the layer deeper; the line through the last two, as in the
/// secant method, is there at once.
class NextStroke {
  public:
    /// @param amplitude  m, that was tried  @param under_it  m, that the exciter gives under its layer
    double after(double amplitude, double under_it) {
        double slope = 0;
        if (tried_ && tried_->first != amplitude)
            slope = (under_it - tried_->second) / (amplitude - tried_->first);
        tried_ = {amplitude, under_it};
        double const step = (under_it - amplitude) / (1 - std::min(slope, steepest));
        return std::max(amplitude + step, under_it / 2);
    }

  private:
    std::optional<std::pair<double, double>> tried_;
};

}  // namespace

double material_on(DesignTask const& task, double depth) {
    return task.bulk_density * task.width * task.length * depth;
}

std::optional<atlas::LayerLoad> load_of(DesignTask const& task, RiskDesign const& design) {
    if (!task.grain_diameter) return {};
    theory::Drive const& drive = design.drive;
    atlas::Place const place = atlas::place_of(
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
    double material = material_guessed(task);
    double amplitude = amplitude_of(machine, task.space.frequency.low, material);
    NextStroke next;
    for (int i = 0; i < most_repetitions; ++i) {
        one.space.amplitude = {amplitude, amplitude};
        double const by_load = amplitude_sd(machine, task.space.frequency.low, material);
        one.errors.amplitude = std::hypot(task.errors.amplitude, by_load);
        ChosenDesign found = find(one);
        settle_load(found.task, found.design);
        machine = *found.task.machine;
        material = material_on(task, found.design.depth);
        double const under_it = amplitude_of(machine, task.space.frequency.low, material);
        if (std::abs(under_it / amplitude - 1) < same_stroke) return found;
        amplitude = next.after(amplitude, under_it);
    }
    throw std::invalid_argument(
        "the stroke and the depth of the layer change each other without an end; give the stroke by "
        "--stroke");
}

}  // namespace vibrotrough::learn
