#pragma once

#include "scenario/reader/written_campaign.hpp"
#include "store/case_record.hpp"
#include "store/schema.hpp"

#include <memory>

namespace vibrotrough::store {

/// Columns of `length` values that differ from one another and from packing to packing.
inline void fill_layer(PackingRecord& packing, double first) {
    packing.motion.mode = "FP'N";
    packing.motion.period_cycles = 1;
    packing.motion.take_off_phase = 0.5 + first;
    packing.motion.landing_phase = 4.5 + first;
    packing.motion.flight_number = 0.625;
    packing.motion.restitution = 0.0625;
    packing.motion.dissipation = 0.001 + first / 1024;
    packing.motion.floor_slip = 0.03;
    packing.motion.largest_overlap = 3e-5 * (1 + first);
    packing.motion.largest_floor_overlap = 2e-5;
    packing.motion.added_mass = 0.002 + first / 64;
    packing.motion.damping = 0.25 + first;
    packing.motion.trough_power = 0.5 + first;
    packing.profiles.velocity_gradient = -0.01;
    packing.surface.wiggle_amplitude = 0.0008;
    double value = first;
    for (PackingTable const& table : packing_tables()) {
        bool const is_of_layer =
            table.name == "phases" || table.name == "profiles" || table.name == "surface";
        if (!is_of_layer) continue;
        std::size_t const length = table.name == "phases" ? 5 : table.name == "profiles" ? 4 : 3;
        for (PackingColumn const& column : table.columns)
            for (std::size_t i = 0; i < length; ++i) column.field(packing).push_back(value += 0.25);
    }
    packing.profiles.phase = {0, 0, 3, 3};  // two phases of two bins
    packing.profiles.height = {0.001, 0.0025, 0.001, 0.0025};
    packing.granular_temperature = 0.01 + first;
}

/// A case with two packings of different length whose numbers are easy to tell apart.
/// `id` and `throw_number` may be chosen to make several.
inline CaseRecord sample_record(std::string const& id = "0123456789abcdef", double frequency = 13.5) {
    auto const made =
        std::make_unique<scenario::Scenario>();  // on the stack, GCC 12 takes it for uninitialized
    scenario::Scenario& scenario = *made;
    scenario.campaign = "sample";
    scenario.trough.inclination = -0.05;
    scenario.trough.vibration_angle = 0.5;
    scenario.trough.amplitude = 0.006;
    scenario.trough.frequency = frequency;
    scenario.trough.friction = 0.23;
    scenario.trough.restitution = 0.4;
    scenario.grains = {.diameter = 0.003,
                       .diameter_spread = 0.1,
                       .density = 1400.0,
                       .youngs_modulus = 5e6,
                       .poisson_ratio = 0.35,
                       .friction = 0.5,
                       .restitution = 0.6,
                       .rolling_friction = 0.0};
    scenario.layer = {.length = 0.036, .width = 0.018, .height = {}, .grains = 500};
    scenario.measure = {.packings = 2, .confidence = 0.95, .half_width = 0.02, .max_cycles = 200};
    scenario.output = {.frames_per_cycle = 0};

    PackingRecord first{};
    first.seed = 49979687;
    first.steps_per_cycle = 3000;
    first.time_step = 2.4493014e-5;
    first.mass = 0.0099;
    first.wall_time = 12.5;
    first.core_time = 11.5;
    first.start_efficiency = 0.25;
    first.series = {.x = {0.018, 0.0241, 0.0337, 0.0431},
                    .z = {0.0096, 0.0130, 0.0095, 0.0096},
                    .vz = {0.0, 0.21, -0.04, 0.02},
                    .mean_velocity = {0.0839, 0.1304, 0.1707},
                    .normal_force = {0.0885, 0.1418, 0.0974},
                    .tangential_force = {0.0152, 0.0057, 0.0127},
                    .flight_fraction = {0.652, 0.356, 0.654}};
    first.efficiency = {0.41, 0.62, 0.83};
    first.estimate = {.mean = 0.83,
                      .half_width = 0.018,
                      .discarded = 2,
                      .measured = 1,
                      .correlation_time = 1.5,
                      .verdict = measure::Verdict::precise};
    first.deck = "# deck of packing 1, angle \xCE\xB2\nrun 3000\n";

    PackingRecord second = first;
    fill_layer(first, 0);
    fill_layer(second, 0.5);
    second.motion.period_cycles = 2;
    second.seed = 86028121;
    second.wall_time = 11.25;
    second.start_efficiency.reset();
    second.series = {.x = {0.018, 0.025},
                     .z = {0.0097, 0.0098},
                     .vz = {0.0, -0.03},
                     .mean_velocity = {0.0953},
                     .normal_force = {0.0991},
                     .tangential_force = {-0.0012},
                     .flight_fraction = {0.68}};
    second.efficiency = {0.81};
    second.estimate = {.mean = 0.81,
                       .half_width = 0.03,
                       .discarded = 0,
                       .measured = 1,
                       .correlation_time = 2.25,
                       .verdict = measure::Verdict::not_precise};
    second.deck = "# deck of packing 2\n";

    return {.id = id,
            .scenario = scenario,
            .scenario_toml = to_toml(scenario),
            .outcome = core::Outcome::not_precise,
            .estimate = {.mean = 0.82,
                         .half_width = 0.127,
                         .packings = 2,
                         .correlation_time = 1.75,
                         .deviation = 0.0141,
                         .deviation_within = 0.01,
                         .drift = 0.03125,
                         .below = measure::Branch{0.83, {}, 1},
                         .above = measure::Branch{0.81, {}, 1}},
            .packings = {first, second},
            .provenance = {.program_version = "0.1.0",
                           .git_commit = "abcdef",
                           .engine_version = "LIGGGHTS 3.8.0",
                           .engine_certificate = "{\"verdict\": \"passed\"}\n",
                           .host = "trough",
                           .started = "2026-11-21T12:00:00Z",
                           .finished = "2026-11-21T12:01:00Z"},
            .layer_mode = "FP'N"};
}

}  // namespace vibrotrough::store
