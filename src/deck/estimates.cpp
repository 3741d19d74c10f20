#include "deck/estimates.hpp"

#include "deck/deck.hpp"
#include "deck/screen.hpp"
#include "deck/trough_mesh.hpp"
#include "prepare/contact.hpp"

#include <algorithm>
#include <cmath>

#include <boost/math/distributions/students_t.hpp>

namespace vibrotrough::deck {
namespace {

/// The contacts of a frame: a line has 175 bytes, and a frame of a layer that is thrown high has a third of a
/// contact for each sphere, one of a layer at rest 2.5.
double contact_bytes(double spheres) {
    return 1000 + 175 * 0.8 * spheres;
}

/// A mean grain on the trough.
prepare::ContactPair mean_grain(scenario::Scenario const& s) {
    return {mean_diameter(s) / 2, mean_density(s) * mean_grain_volume(s)};
}

std::unique_ptr<prepare::Contact const> contact_of(prepare::PreparedCase const& c) {
    return prepare::contact_of(c.scenario, c.time.impact_speed);
}

double sphere_count(prepare::PreparedCase const& c) {
    return static_cast<double>(c.scenario.layer.grains) * c.spheres_per_grain;
}

double mean_mass(scenario::Scenario const& s) {
    return mean_density(s) * mean_grain_volume(s);
}

}  // namespace

double bottom_load(prepare::PreparedCase const& c) {
    scenario::Scenario const& s = c.scenario;
    return c.weight * mean_diameter(s) * mean_diameter(s) / (s.layer.length * s.layer.width);
}

double overlap_under(prepare::PreparedCase const& c, double force) {
    return contact_of(c)->overlap_under(mean_grain(c.scenario), force);
}

namespace {

double usual_height_at_rest(prepare::PreparedCase const& c) {
    return 1e-7 * mean_diameter(c.scenario);
}

}  // namespace

double height_at_rest(prepare::PreparedCase const& c) {
    double const usual = usual_height_at_rest(c);
    if (c.scenario.layer.block != scenario::Block::none || c.domain.open) return usual;
    double const compressed =
        c.layer_height / mean_diameter(c.scenario) * overlap_under(c, bottom_load(c) / 2);
    return std::min(usual, 1e-4 * compressed);
}

double rest_tolerance(prepare::PreparedCase const& c) {
    return height_at_rest(c) < usual_height_at_rest(c) ? 0.08 : 0.02;
}

double overlap_at_impact(prepare::PreparedCase const& c, double speed) {
    return contact_of(c)->overlap_of_impact(mean_grain(c.scenario), speed);
}

double impact_duration(prepare::PreparedCase const& c, double speed) {
    scenario::Scenario const& s = c.scenario;
    if (s.layer.block != scenario::Block::none) return 1 / (s.trough.frequency * s.solver.block_stiffness);
    return contact_of(c)->duration(mean_grain(s), speed, s.trough.restitution);
}

double bond_number(prepare::PreparedCase const& c) {
    scenario::Scenario const& s = c.scenario;
    double const weight = mean_mass(s) * s.trough.gravity * std::cos(s.trough.inclination);
    return contact_of(c)->pull_off_force(mean_grain(s)) / weight;
}

std::optional<double> attraction_ratio(prepare::PreparedCase const& c) {
    return contact_of(c)->attraction_ratio(mean_grain(c.scenario));
}

double flight_time(prepare::PreparedCase const& c) {
    if (c.throw_number <= 1) return 0;
    return theory::solve(c.point_mass.conveyor.point).flight_number / c.scenario.trough.frequency;
}

double steps_between_rebuilds(prepare::PreparedCase const& c, double speed) {
    scenario::Scenario const& s = c.scenario;
    return skin_in_diameters * mean_diameter(s) / 2 / (speed * c.time.time_step);
}

double trusted_half_width(int packings, scenario::MeasurementPlan const& statistics, double whole) {
    constexpr int trusted_packings = 6;
    constexpr double share_for_few = 0.5;
    bool const are_few = packings > 1 && packings < std::min(trusted_packings, statistics.max_packings);
    return are_few ? std::min(share_for_few * whole, statistics.half_width) : statistics.half_width;
}

int expected_packings(scenario::Scenario const& scenario, Experience const& experience) {
    return expected_packings(prepare::statistics_plan(scenario), scenario.measure.half_width, experience);
}

int expected_packings(scenario::MeasurementPlan const& plan, double whole, Experience const& experience) {
    if (plan.max_packings == 1) return 1;
    double const level = 1 - 0.5 * (1 - plan.confidence);  // see measure/case_estimate.hpp
    int packings = plan.packings + plan.packings % 2;
    for (; packings < plan.max_packings; ++packings) {
        boost::math::students_t const distribution(packings - 1);
        double const quantile = boost::math::quantile(distribution, 0.5 + level / 2);
        double const enough = trusted_half_width(packings, plan, whole);
        if (quantile * experience.deviation <= enough * std::sqrt(packings)) break;
    }
    return std::min(packings, plan.max_packings);
}

bool may_start_moving(scenario::Scenario const& scenario) {
    return !is_clump(scenario.grains) && scenario.layer.block == scenario::Block::none &&
           scenario.trough.vibration_angle > 0 && !has_given_length(scenario) && !is_open(scenario);
}

int first_round_cycles(scenario::Scenario const& scenario) {
    constexpr double fewest = 18, most = 24, cycles_times_half_width = 1.35;
    scenario::MeasurementPlan const& plan = scenario.measure;
    if (has_given_length(scenario)) return plan.max_cycles;
    double cycles = most;
    if (plan.packings > 1 && may_start_moving(scenario))
        cycles = std::clamp(std::round(cycles_times_half_width / plan.half_width), fewest, most);
    return std::min(std::max(static_cast<int>(cycles), plan.min_cycles.value_or(0)), plan.max_cycles);
}

double expected_cycles(scenario::Scenario const& scenario, Experience const& experience) {
    return std::min<double>(experience.cycles.value_or(first_round_cycles(scenario)),
                            scenario.measure.max_cycles);
}

bool is_plain(prepare::PreparedCase const& c) {
    return !c.domain.has_mesh() && !c.domain.open && !c.domain.screen && c.stages.empty();
}

double work_of(prepare::PreparedCase const& c, double settlings, double cycles) {
    // A triangle of a moving mesh takes as long as a grain on one machine (216 grains on 12, 672 and 3600
    // triangles took 0.55, 2.2 and 10.6 s for 12,000 steps, 301 grains in a chute of 242 and 2560 triangles 6
    // and 27 s for 42,000) and 0.4 to 0.7 grains on another one. Flat floors have a few triangles only.
    constexpr double triangle_in_grains = 0.55;
    // Grains that are fed and leave, and walls that they touch: 2.1 times without a screen, 1.3 with one.
    double const of_feed = c.domain.open ? 1.8 : 1;
    double const settling = 5 * std::sqrt(2 * c.fill_top / c.scenario.trough.gravity) / c.settle_time_step;
    // A harmonic of the drive along one axis, whose sines the engine works out in every step, takes as long
    // as 20 grains: 209 grains took 33 us for a step with a sinusoid, which has 2 of them, 51 us with 8 and
    // 156 us with 40. A sinusoid is part of the usual speed.
    constexpr double harmonic_in_grains = 20;
    bool const is_record = c.scenario.trough.waveform && c.stages.empty();  // of which the engine has a sum
    double const harmonics =
        is_record ? 0 : static_cast<double>(c.motion.along.size() + c.motion.normal.size());
    double triangles = triangles_of_screen(c);
    if (c.domain.has_mesh())
        for (auto const& part : own_trough(c)) triangles += static_cast<double>(part.size());
    double const beside_grains =
        triangle_in_grains * triangles + harmonic_in_grains * std::max(0.0, harmonics - 2);
    return of_feed * (c.work(settlings * settling / c.time.steps_per_cycle + cycles) +
                      beside_grains * c.time.steps_per_cycle * cycles);
}

double expected_work(prepare::PreparedCase const& c, double packings, Experience const& experience) {
    return work_of(c, packings, packings * expected_cycles(c.scenario, experience));
}

double expected_bytes(prepare::PreparedCase const& c) {
    return bytes_of(c, expected_packings(c.scenario), expected_cycles(c.scenario));
}

double largest_bytes(prepare::PreparedCase const& c) {
    scenario::MeasurementPlan const& plan = c.scenario.measure;
    return bytes_of(c, plan.max_packings, plan.max_cycles);
}

double bytes_of(prepare::PreparedCase const& c, double packings, double cycles) {
    scenario::Scenario const& s = c.scenario;
    double const spheres = sphere_count(c);
    double const bins = std::ceil((c.box_top - c.box_bottom) / (mean_diameter(s) / 2));
    double const columns = std::max(1.0, std::round(s.layer.length / (1.5 * mean_diameter(s))));
    double const snapshots = static_cast<double>(profiles_per_cycle) / profile_stride;
    // Mean lengths of the rows of phases.csv, cycles.csv, profiles.N.txt, surface.N.txt and of a dump.
    double const per_cycle =
        253.0 * prepare::phases_per_cycle + 140 + snapshots * (25 + 22.5 * bins + 35 * columns);
    double const frames = s.output.frames_per_cycle * cycles *
                          packings_with_frames(s.output, static_cast<int>(std::ceil(packings)));
    double const per_frame = 300 + 102 * spheres + (s.output.contacts ? contact_bytes(spheres) : 0);
    // The engine's output, the deck and the marker of the run and of its settling; settled.restart and one
    // checkpoint.
    double const per_packing = 175e3 + (350 + 310) * spheres;
    double const result = 100e3 + packings * (15e3 + 72 * cycles);
    return packings * (per_packing + cycles * per_cycle) + frames * per_frame + result;
}

double expected_memory(prepare::PreparedCase const& c, int ranks) {
    return 36e6 * ranks + 2700 * sphere_count(c);
}

}  // namespace vibrotrough::deck
