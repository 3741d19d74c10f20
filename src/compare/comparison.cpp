#include "compare/comparison.hpp"

#include "compare/point_mass_motion.hpp"
#include "theory/point_mass.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <tuple>

#include <fmt/format.h>

namespace vibrotrough::compare {
namespace {

/// Converted quantities keep 12 digits: 30 degrees is 30, not 30.000000000000004.
double rounded(double value) {
    if (value == 0 || !std::isfinite(value)) return value;
    double const scale = std::pow(10.0, 11 - std::floor(std::log10(std::abs(value))));
    return std::round(value * scale) / scale;
}

/// A mass that runs away, for example, has no mode.
std::optional<std::string> known_mode(theory::Motion const& motion) {
    if (motion.mode.empty()) return {};
    return motion.mode;
}

void add_theory(Row& row, scenario::Scenario const& scenario) {
    theory::Motion const motion = point_mass_motion(scenario, scenario.trough.friction);
    row.mode_theory = known_mode(motion);
    if (motion.converged) row.efficiency_theory = motion.velocity_efficiency;
}

void add_layer_theory(Row& row, scenario::Scenario const& scenario, MeasuredFriction const& measured) {
    row.friction_layer = measured.friction;
    row.friction_layer_low = measured.low;
    row.friction_layer_high = measured.high;
    scenario::Scenario without_walls = scenario;  // their effect is included in the measured friction
    without_walls.trough.side_wall_friction.reset();
    theory::Motion const motion = point_mass_motion(without_walls, measured.friction);
    row.mode_theory_layer = known_mode(motion);
    if (motion.converged) row.efficiency_theory_layer = motion.velocity_efficiency;
}

/// The mean over the packings that have the number.
std::optional<double> mean_of(store::CaseRecord const& record,
                              std::optional<double> measure::LayerMotion::*number) {
    double sum = 0;
    int count = 0;
    for (store::PackingRecord const& packing : record.packings) {
        std::optional<double> const value = packing.motion.*number;
        if (!value) continue;
        sum += *value;
        ++count;
    }
    if (count == 0) return {};
    return sum / count;
}

void add_measurement(Row& row, store::CaseRecord const& record) {
    row.packings = record.estimate.packings;
    if (!record.layer_mode.empty()) row.mode_layer = record.layer_mode;
    row.cycles_measured = row.cycles_discarded = 0;
    row.wall_s = 0;
    for (store::PackingRecord const& packing : record.packings) {
        *row.cycles_measured += packing.estimate.measured;
        *row.cycles_discarded += packing.estimate.discarded;
        *row.wall_s += packing.wall_time;
    }
    if (record.outcome == "not-steady") return;  // no mean is reported unless the case is steady
    row.efficiency_dem = record.estimate.mean;
    row.efficiency_dem_half_width = record.estimate.half_width;
    if (record.estimate.mean)
        row.speed_dem_m_per_s = *record.estimate.mean * velocity_scale(record.scenario.trough);
    row.efficiency_by_normal_force = mean_of(record, &measure::LayerMotion::efficiency_by_normal_force);
    row.landing_friction = mean_of(record, &measure::LayerMotion::landing_friction);
}

constexpr double degrees = 180 / std::numbers::pi;

/// What a line of the figure holds fixed.
using Line = std::tuple<double, double, double>;  // vibration angle and inclination, deg; friction

std::string curve(Line const& line, double from, double to) {
    constexpr int points = 400;  // finer than a print shows
    auto const [angle, inclination, friction] = line;
    std::string text;
    for (int i = 0; i <= points; ++i) {
        double const gamma = from + (to - from) * i / points;
        theory::Motion const motion = theory::solve({.throw_number = gamma,
                                                     .tan_vibration_angle = std::tan(angle / degrees),
                                                     .tan_inclination = std::tan(inclination / degrees),
                                                     .friction = friction});
        if (!motion.converged) continue;
        text += fmt::format("{:.6g},{},{},{},{}\n", gamma, angle, inclination, friction,
                            motion.velocity_efficiency);
    }
    return text;
}

}  // namespace

std::string theory_curves_csv(std::vector<Row> const& rows) {
    std::string text = "throw_number,vibration_angle_deg,inclination_deg,friction,velocity_efficiency\n";
    std::set<Line> lines;
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (Row const& row : rows) {
        if (!(row.vibration_angle_deg > 0)) continue;
        lines.insert({row.vibration_angle_deg, row.inclination_deg, row.friction});
        least = std::min(least, row.throw_number);
        most = std::max(most, row.throw_number);
    }
    for (Line const& line : lines) text += curve(line, 0.9 * least, 1.1 * most);
    return text;
}

Row compare(std::string const& id, scenario::Scenario const& scenario,
            std::optional<store::CaseRecord> const& record, std::string const& outcome,
            std::optional<MeasuredFriction> const& friction) {
    scenario::Trough const& trough = scenario.trough;
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
    add_theory(row, scenario);
    if (friction) add_layer_theory(row, scenario, *friction);
    if (record) add_measurement(row, *record);
    return row;
}

}  // namespace vibrotrough::compare
