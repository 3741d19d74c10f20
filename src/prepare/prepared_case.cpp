#include "prepare/prepared_case.hpp"

#include "prepare/open_trough.hpp"
#include "prepare/screen.hpp"
#include "scenario/model/softness.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace vibrotrough::prepare {
namespace {

/// Grains are poured at a low solid fraction, so that random insertion always finds space for them.
constexpr double poured_solid_fraction = 0.2;

/// Numbers of grains whose running sums are closest to those of the fractions, so that the mean size is kept
/// and a single grain has the middle size.
template <typename Part>
std::vector<int> count_parts(std::vector<Part> const& parts, int count) {
    std::vector<int> counts;
    double fraction = 0;
    int so_far = 0;
    for (Part const& part : parts) {
        fraction += part.number_fraction;
        int const target = std::max(so_far, static_cast<int>(std::lround(fraction * count)));
        counts.push_back(target - so_far);
        so_far = target;
    }
    return counts;
}

/// @param all  also those sizes that the layer has less than one grain of, with one
std::vector<ClassCount> count_classes(std::vector<scenario::Material> const& materials, int grains,
                                      bool all) {
    std::vector<ClassCount> classes;
    std::vector<int> const of_material = count_parts(materials, grains);
    for (std::size_t m = 0; m < materials.size(); ++m) {
        auto const sizes = size_classes(materials[m].grains);
        std::vector<int> const of_size = count_parts(sizes, of_material[m]);
        for (std::size_t i = 0; i < sizes.size(); ++i)
            if (all || of_size[i] > 0)
                classes.push_back({sizes[i].diameter, std::max(1, of_size[i]), static_cast<int>(m),
                                   materials[m].number_fraction * sizes[i].number_fraction});
    }
    std::ranges::stable_sort(classes, std::greater(), &ClassCount::diameter);
    return classes;
}

/// The smallest of unit, 4 unit, 16 unit ... that is at least `needed`. Because of these large steps, cases
/// that differ only in their drives mostly have the same box and can share settled packings.
double in_powers_of_four(double unit, double needed) {
    while (unit < needed) unit *= 4;
    return unit;
}

/// Takes the bounds of another drive into account.
void add_bounds(PreparedCase& c, scenario::Trough const& trough) {
    scenario::DriveMotion const motion = drive_motion(trough);
    c.largest_speed = std::max(c.largest_speed, largest_speed(motion, angular_frequency(trough)));
    c.largest_excursion = std::max(c.largest_excursion, largest_excursion(motion));
    c.highest_order = std::max(c.highest_order, highest_order(motion));
}

/// In a ramp the displacement is at most that of either stage, at the higher of the two frequencies. Its
/// change with the ramp itself adds the difference of the displacements in the time of the ramp.
void add_ramp(PreparedCase& c, scenario::Stage const& stage, double excursion_before) {
    scenario::Trough faster = stage.trough;
    faster.frequency = std::max(stage.first_frequency, stage.trough.frequency);
    add_bounds(c, faster);
    double const change = 2 * (excursion_before + largest_excursion(drive_motion(stage.trough)));
    c.largest_speed =
        std::max(c.largest_speed, largest_speed(drive_motion(stage.trough), angular_frequency(faster)) +
                                      change / stage.ramp_time());
}

void prepare_drive(PreparedCase& c) {
    scenario::Trough const& trough = c.scenario.trough;
    c.stages = stages(c.scenario);
    c.motion = drive_motion(trough);
    c.throw_number = throw_number(trough);
    c.machine_number = machine_number(trough);
    c.angular_frequency = angular_frequency(trough);
    c.velocity_scale = velocity_scale(trough);
    c.largest_speed = c.largest_excursion = c.highest_order = 0;
    if (c.stages.empty()) add_bounds(c, trough);
    double excursion = 0;
    for (scenario::Stage const& stage : c.stages) {
        add_bounds(c, stage.trough);
        if (stage.ramp_cycles > 0) add_ramp(c, stage, excursion);
        excursion = stage.standstill ? 0 : largest_excursion(drive_motion(stage.trough));
    }
}

/// The scenario with the drive of one stage, without end.
scenario::Scenario with_drive_of(scenario::Scenario scenario, scenario::Stage const& stage) {
    scenario.trough = stage.trough;
    scenario.stages.clear();
    return scenario;
}

void prepare_grains(PreparedCase& c) {
    scenario::Scenario const& s = c.scenario;
    c.materials = materials(s);
    bool const is_fed_mixture = is_open(s) && c.materials.size() > 1;
    c.classes = count_classes(c.materials, s.layer.grains, is_fed_screen(s) || is_fed_mixture);
    for (ClassCount& size : c.classes)
        if (!is_fed_mixture) size.share = size.count;
    if (s.layer.block == scenario::Block::plate) c.clump = make_plate(s.grains.diameter);
    if (is_clump(s.grains)) c.clump = make_clump(s.grains);
    c.spheres_per_grain = c.clump ? static_cast<int>(c.clump->spheres.size()) : 1;
    double one_of_each = 0;
    for (ClassCount const& size : c.classes) {
        double const sphere = std::numbers::pi / 6 * std::pow(size.diameter, 3);
        double const density = c.materials[static_cast<std::size_t>(size.material)].grains.density;
        c.mass += size.count * density * (c.clump ? c.clump->volume : sphere);
        one_of_each += density * sphere;
    }
    c.weight = c.mass * s.trough.gravity * std::cos(s.trough.inclination);
    c.settled_grains = is_open(s) ? static_cast<int>(c.classes.size()) : s.layer.grains;
    c.settled_weight = is_open(s) ? c.weight * one_of_each / c.mass : c.weight;
    c.layer_height = layer_height(s);
}

/// A case that is no part of a campaign may still have none.
void prepare_modulus(PreparedCase& c) {
    scenario::choose_modulus({&c.scenario, 1});
    for (scenario::Material& material : c.materials)
        material.grains.youngs_modulus = c.scenario.grains.youngs_modulus;
    c.numerics = numerical_errors(c.scenario);
}

void prepare_filling(PreparedCase& c) {
    scenario::Scenario const& s = c.scenario;
    double const ratio = c.clump ? 2 * c.clump->bounding_radius / s.grains.diameter : 1;
    double bounding_volume = 0;
    for (ClassCount const& size : c.classes) {
        double const sphere = std::numbers::pi / 6 * std::pow(size.diameter, 3);
        bounding_volume += size.count * sphere * std::pow(ratio, 3);
    }
    c.largest_extent = c.classes.front().diameter * ratio;
    double const width = s.layer.width - (c.domain.is_closed ? c.largest_extent : 0);
    c.fill_bottom = c.domain.floor_top + 0.6 * c.largest_extent;
    c.fill_top =
        c.fill_bottom + c.largest_extent +
        bounding_volume / (poured_solid_fraction * s.layer.length * std::max(width, 0.2 * s.layer.width));
}

void prepare_time(PreparedCase& c) {
    scenario::Scenario const& s = c.scenario;
    // The spheres of a plate have the diameter of the grains, so only clumps need a radius of their own.
    double const radius = is_clump(s.grains) ? c.clump->smallest_radius : smallest_diameter(s) / 2;
    StepLimits const limits{radius, c.largest_speed, c.highest_order};
    c.settle_speed = settling_speed(c.fill_top, s.trough.gravity);
    c.settle_time_step = settling_time_step(s, limits, c.fill_top);
    if (c.stages.empty()) {
        c.time = choose_time_step(s, limits);
        return;
    }
    std::vector<TimeGrid> grids;
    for (scenario::Stage const& stage : c.stages)
        grids.push_back(choose_time_step(with_drive_of(s, stage), limits));
    int const steps = std::ranges::max(grids, {}, &TimeGrid::steps_per_cycle).steps_per_cycle;
    for (TimeGrid& grid : grids) grid = with_steps(grid, steps);
    c.time = std::ranges::max(grids, {}, &TimeGrid::time_step);
}

/// The box is so high that it holds a grain at ten times the height that a throw with the trough's largest
/// speed reaches.
void prepare_box(PreparedCase& c) {
    double const flight = c.largest_speed * c.largest_speed /
                          (2 * c.scenario.trough.gravity * std::cos(c.scenario.trough.inclination));
    double const excursion = c.largest_excursion;
    c.box_top = in_powers_of_four(8 * (c.fill_top + 5 * c.largest_extent),
                                  c.fill_top + 10 * flight + 5 * c.largest_extent);
    c.box_bottom = -in_powers_of_four(4 * c.largest_extent, 2 * (excursion + c.largest_extent));
    c.wall_height = c.box_top - (excursion - c.box_bottom);
    if (is_screen(c.scenario)) {
        c.domain.screen = screen_floor(c);
        // Without holes the box is that of the plain floor, so that the motion is the same, digit for digit.
        if (has_holes(c.scenario) && !is_open(c.scenario))
            c.box_bottom = std::min(c.box_bottom, c.domain.screen->catch_z - c.largest_extent);
    }
    if (!is_open(c.scenario)) return;
    c.domain.open = open_trough(c);
    c.box_top = std::max({c.box_top, 2 * c.domain.open->feed_top, 2 * c.domain.top});
    c.box_bottom = c.domain.open->box_bottom;
    c.wall_height = c.box_top - 2 * (excursion + c.largest_extent);
}

}  // namespace

double PreparedCase::grain_steps(double cycles) const {
    return scenario.layer.grains * static_cast<double>(spheres_per_grain) * time.steps_per_cycle * cycles;
}

double PreparedCase::step_cost() const {
    return relative_step_cost(scenario.layer.grains * static_cast<double>(spheres_per_grain));
}

double PreparedCase::work(double cycles) const {
    return grain_steps(cycles) * step_cost();
}

double relative_step_cost(double spheres) {
    constexpr double most = 2, half_way = 30000, steepness = 1.5;
    return 1 + most / (1 + std::pow(half_way / spheres, steepness));
}

PreparedCase prepare_case(scenario::Scenario const& scenario) {
    PreparedCase prepared{};
    prepared.scenario = scenario;
    prepare_drive(prepared);
    prepared.domain = domain_of(scenario);
    prepare_grains(prepared);
    prepare_modulus(prepared);
    prepare_filling(prepared);
    prepare_time(prepared);
    prepare_box(prepared);
    prepared.point_mass = point_mass_inputs(prepared.scenario, prepared.motion, prepared.layer_height);
    return prepared;
}

PreparedCase of_stage(PreparedCase const& prepared, scenario::Stage const& stage) {
    PreparedCase one = prepared;
    one.scenario = with_drive_of(prepared.scenario, stage);
    prepare_drive(one);
    TimeGrid const& time = prepared.time;
    double const longer = 1 / (stage.trough.frequency * time.steps_per_cycle * time.time_step);
    one.time = {longer * time.time_step, time.steps_per_cycle, longer * time.rayleigh_fraction,
                longer * time.contact_fraction, time.impact_speed};
    one.numerics = numerical_errors(one.scenario);
    one.point_mass = point_mass_inputs(one.scenario, one.motion, one.layer_height);
    return one;
}

}  // namespace vibrotrough::prepare
