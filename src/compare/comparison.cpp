#include "compare/comparison.hpp"

#include "theory/point_mass.hpp"

#include <cmath>
#include <numbers>

namespace vibrotrough::compare {
namespace {

/// Converted quantities keep 12 digits: 30 degrees is 30, not 30.000000000000004.
double rounded(double value) {
    if (value == 0 || !std::isfinite(value)) return value;
    double const scale = std::pow(10.0, 11 - std::floor(std::log10(std::abs(value))));
    return std::round(value * scale) / scale;
}

void add_theory(Row& row, Trough const& trough) {
    if (!(trough.vibration_angle > 0)) return;
    theory::Motion const motion = theory::solve({.throw_number = throw_number(trough),
                                                 .tan_vibration_angle = std::tan(trough.vibration_angle),
                                                 .tan_inclination = std::tan(trough.inclination),
                                                 .friction = trough.friction});
    row.mode_theory = motion.mode;
    if (motion.converged) row.efficiency_theory = motion.velocity_efficiency;
}

void add_measurement(Row& row, store::CaseRecord const& record) {
    row.packings = record.estimate.packings;
    row.cycles_measured = row.cycles_discarded = 0;
    row.wall_s = 0;
    for (store::PackingRecord const& packing : record.packings) {
        *row.cycles_measured += packing.estimate.measured;
        *row.cycles_discarded += packing.estimate.discarded;
        *row.wall_s += packing.wall_time;
    }
    if (record.outcome == "not-steady") return;  // a mean of what is no steady state is no number
    row.efficiency_dem = record.estimate.mean;
    if (std::isfinite(record.estimate.half_width)) row.efficiency_dem_half_width = record.estimate.half_width;
    row.speed_dem_m_per_s = record.estimate.mean * velocity_scale(record.scenario.trough);
}

}  // namespace

Row compare(std::string const& id, Scenario const& scenario, std::optional<store::CaseRecord> const& record,
            std::string const& outcome) {
    constexpr double degrees = 180 / std::numbers::pi;
    Trough const& trough = scenario.trough;
    Row row{};
    row.id = id;
    row.throw_number = rounded(throw_number(trough));
    row.machine_number = rounded(machine_number(trough));
    row.vibration_angle_deg = rounded(trough.vibration_angle * degrees);
    row.inclination_deg = rounded(trough.inclination * degrees);
    row.friction = trough.friction;
    row.amplitude_m = trough.amplitude;
    row.frequency_hz = rounded(trough.frequency);
    row.outcome = record ? record->outcome : outcome;
    add_theory(row, trough);
    if (record) add_measurement(row, *record);
    return row;
}

}  // namespace vibrotrough::compare
