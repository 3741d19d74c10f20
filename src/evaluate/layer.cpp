#include "evaluate/layer.hpp"

#include "core/error.hpp"
#include "deck/deck.hpp"
#include "measure/granular_temperature.hpp"
#include "measure/landing.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace vibrotrough::evaluate {
namespace {

measure::LayerFacts facts_of(store::PackingRecord const& record, scenario::Scenario const& s) {
    return {record.mass,
            -s.trough.gravity * std::sin(s.trough.inclination),
            -s.trough.gravity * std::cos(s.trough.inclination),
            s.trough.frequency,
            record.estimate.discarded,
            record.estimate.discarded + record.estimate.measured};
}

/// Where the trough is and how fast, at each phase of the snapshots; phase 0 is the end of a cycle.
void add_trough(measure::ProfileFacts& facts, measure::PhaseSeries const& series,
                measure::PhaseCurves const& curves) {
    constexpr int lines = measure::PhaseSeries::per_cycle;
    for (int phase = 0; phase < facts.phases; ++phase) {
        auto const line = static_cast<std::size_t>((phase * lines / facts.phases + lines - 1) % lines);
        facts.trough_z.push_back(series.trough_z.at(line));
        facts.trough_vx.push_back(curves.trough_velocity_x.at(line));
        facts.trough_vz.push_back(curves.trough_velocity_z.at(line));
    }
}

/// The engine gives every sphere of a clump the clump's whole mass, and counts the room behind side walls as
/// the layer's. Then the profile's own sum, which is the layer's mass, says by how much its densities are
/// off.
void scale_solid_fraction(measure::Profiles& profiles, scenario::Scenario const& s, double mass) {
    std::size_t bins = 0;
    double sum = 0;
    while (bins < profiles.phase.size() && profiles.phase[bins] == profiles.phase[0])
        sum += profiles.solid_fraction[bins++];
    if (!(sum > 0)) return;
    double const wanted = mass / (mean_density(s) * s.layer.length * s.layer.width * mean_diameter(s) / 2);
    for (double& fraction : profiles.solid_fraction) fraction *= wanted / sum;
}

/// How much of the difference to the theory comes from the layer's normal force and from its landing. Not
/// with several materials, which have several frictions, nor with side walls or a mesh, whose inclined
/// surfaces carry a part of the load that the force on the floor does not show.
void add_friction_numbers(measure::LayerMotion& motion, prepare::PreparedCase const& prepared) {
    scenario::Scenario const& s = prepared.scenario;
    if (s.trough.side_wall_friction || s.trough.mesh || !s.materials.empty()) return;
    motion.landing_friction = measure::landing_friction(motion);
    motion.efficiency_by_normal_force = measure::efficiency_by_normal_force(
        motion.curves, {prepared.mass, s.trough.friction, -s.trough.gravity * std::sin(s.trough.inclination),
                        s.trough.frequency, prepared.velocity_scale});
}

}  // namespace

measure::PhaseSeries packing_phases(prepare::PreparedCase const& prepared, core::TextFile const& file) {
    scenario::Scenario const& s = prepared.scenario;
    auto series = measure::parse_phases(file, prepared.time.steps_per_cycle);
    bool const is_body = is_clump(s.grains) || s.layer.block == scenario::Block::plate;
    double const interval = 1 / (s.trough.frequency * measure::PhaseSeries::per_cycle);
    double const moved = std::abs(std::reduce(series.vx.begin(), series.vx.end())) * interval;
    bool const is_far = moved > measure::surely_counted * s.layer.length;
    if (!(is_body || is_far) || !prepared.stages.empty()) return series;
    return measure::with_integrated_positions(std::move(series), interval);
}

void measure_layer(store::PackingRecord& record, prepare::PreparedCase const& prepared,
                   PackingFiles const& outputs, measure::PhaseSeries const& series) {
    scenario::Scenario const& s = prepared.scenario;
    static_assert(prepare::phases_per_cycle == measure::PhaseSeries::per_cycle);
    measure::LayerFacts const facts = facts_of(record, s);
    if (series.cycles() < facts.used) {
        throw core::InputError(
            fmt::format("{} ends before cycle {}", outputs.phases.path.string(), facts.used));
    }
    // Damaged ones are noticed also where they are not needed.
    auto const profiles = measure::parse_snapshots(outputs.snapshots, outputs.folder, "profiles");
    auto const surface = measure::parse_snapshots(outputs.snapshots, outputs.folder, "surface");
    if (!prepared.stages.empty()) return;  // there is no cycle that repeats
    record.motion = measure::layer_motion(series, facts);
    if (record.motion.curves.phase.empty()) return;                               // too few cycles to look at
    if (prepared.domain.has_mesh()) record.motion.largest_floor_overlap.reset();  // its floor is not a plane
    add_friction_numbers(record.motion, prepared);
    measure::ProfileFacts profile{mean_density(s),
                                  prepared.time.steps_per_cycle,
                                  facts.discarded,
                                  facts.used,
                                  deck::profiles_per_cycle,
                                  {},
                                  {},
                                  {},
                                  record.estimate.mean * prepared.velocity_scale};
    add_trough(profile, series, record.motion.curves);
    record.profiles = measure::layer_profiles(profiles, profile);
    if (is_clump(s.grains) || s.layer.block != scenario::Block::none || prepared.domain.is_closed)
        scale_solid_fraction(record.profiles, s, record.mass);
    record.surface = measure::layer_surface(surface, profile);
    // The engine's energies of clumps are wrong, and those of several materials are not of one mass.
    if (is_clump(s.grains) || s.layer.block != scenario::Block::none || !s.materials.empty()) return;
    constexpr int bins_per_slab = 2;  // the bins are half a diameter high, see deck/phases.cpp
    record.granular_temperature = measure::granular_temperature(
        profiles, series,
        {record.mass, prepared.time.steps_per_cycle, facts.discarded, facts.used, bins_per_slab});
}

std::string common_mode(std::vector<store::PackingRecord> const& packings) {
    std::string common;
    long most = 0;
    for (store::PackingRecord const& one : packings) {
        long const count = std::ranges::count_if(packings, [&](store::PackingRecord const& other) {
            return other.motion.mode == one.motion.mode;
        });
        if (count <= most || one.motion.mode.empty()) continue;
        most = count;
        common = one.motion.mode;
    }
    return common;
}

}  // namespace vibrotrough::evaluate
