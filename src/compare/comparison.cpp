#include "compare/comparison.hpp"

#include "prepare/softness.hpp"
#include "theory/point_mass.hpp"
#include "theory/rolling_layer.hpp"
#include "theory/tested_range.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>

#include <fmt/format.h>

namespace vibrotrough::compare {
namespace {

/// The mode; none when the motion has none, for example when the mass runs away.
std::optional<std::string> known_mode(theory::Motion const& motion) {
    if (motion.mode.empty()) return {};
    return motion.mode;
}

void add_theory(Row& row, prepare::PointMassInputs const& point_mass) {
    theory::Motion const motion = solve(point_mass);
    row.mode_theory = known_mode(motion);
    if (motion.converged) row.efficiency_theory = motion.velocity_efficiency;
}

/// The efficiency of the rolling-layer law where it has been tested, else nothing.
std::optional<double> rolling_efficiency(theory::PointMass const& point, theory::RollingLaw const& law,
                                         std::optional<double> depth = {}) {
    if (theory::outside_tested_range(point, depth)) return {};
    theory::Motion const motion = theory::solve(theory::RollingLayer{point, law}).motion;
    if (!motion.converged) return {};
    return motion.velocity_efficiency;
}

/// Adds the rolling-layer law for a layer of spheres that may rotate, with the contacts with which the law
/// has been tested. Rolling friction adds to its dry
/// torque.
void add_rolling_layer(Row& row, prepare::PreparedCase const& prepared) {
    scenario::Grains const& grains = prepared.scenario.grains;
    bool const spheres = grains.shape == "sphere" && prepared.scenario.layer.block == scenario::Block::none;
    if (!not_covered(prepared.scenario.engine).empty()) return;
    if (!prepared.point_mass.is_plain || !spheres || grains.rotation == scenario::Rotation::blocked) return;
    theory::RollingLaw law;
    if (grains.rotation == scenario::Rotation::rolling) law.dry_torque += grains.rolling_friction;
    double const depth = prepared.layer_height / grains.diameter;
    row.efficiency_rolling_layer = rolling_efficiency(prepared.point_mass.conveyor.point, law, depth);
}

/// Adds the theory at the friction of the layer as a whole. The effect of side walls is already included in
/// it.
void add_layer_theory(Row& row, prepare::PointMassInputs const& point_mass,
                      MeasuredFriction const& measured) {
    row.friction_layer = measured.friction;
    row.friction_layer_low = measured.low;
    row.friction_layer_high = measured.high;
    theory::Motion const motion = solve(prepare::with_friction(point_mass, measured.friction));
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

Interval scaled(Interval const& interval, double factor) {
    if (!interval.half_width) return {factor * interval.mean, {}};
    return {factor * interval.mean, factor * *interval.half_width};
}

/// What the layer carries and does to its machine. The record's scenario gives the size of the layer.
void add_machine(Row& row, store::CaseRecord const& record, scenario::Scenario const& s) {
    double const area = s.layer.length * s.layer.width, mass = mass_per_area(s) * area;
    row.mass_flow_per_width = scaled(*row.speed_dem, mass_per_area(s));
    if (auto const width = trough_width(s)) row.mass_flow = scaled(*row.mass_flow_per_width, *width);
    if (auto const power = mean_of(record, &measure::LayerMotion::trough_power))
        row.power_per_area = *power / area;
    if (auto const damping = mean_of(record, &measure::LayerMotion::damping))
        row.damping_per_area = *damping / area;
    if (auto const added = mean_of(record, &measure::LayerMotion::added_mass)) {
        row.added_mass_per_area = *added / area;
        row.added_mass_fraction = *added / mass;
    }
}

void add_measurement(Row& row, store::CaseRecord const& record, prepare::PreparedCase const& prepared) {
    row.packings = record.estimate.packings;
    if (!record.layer_mode.empty()) row.mode_layer = record.layer_mode;
    row.cycles_measured = row.cycles_discarded = 0;
    row.wall_s = 0;
    for (store::PackingRecord const& packing : record.packings) {
        *row.cycles_measured += packing.estimate.measured;
        *row.cycles_discarded += packing.estimate.discarded;
        *row.wall_s += packing.wall_time;
    }
    if (!has_mean(record.outcome)) return;  // no mean is reported unless the case is steady
    row.efficiency_dem = record.estimate.mean;
    row.efficiency_dem_half_width = record.estimate.half_width;
    row.numerical_error = record.numerical_error();
    if (record.studied) row.numerical_error_case = record.studied->case_id;
    row.whole_half_width = record.whole_half_width();
    if (record.estimate.mean) {
        row.speed_dem = scaled({*record.estimate.mean, row.whole_half_width}, prepared.velocity_scale);
        add_machine(row, record, prepared.scenario);
    }
    row.efficiency_by_normal_force = mean_of(record, &measure::LayerMotion::efficiency_by_normal_force);
    row.landing_friction = mean_of(record, &measure::LayerMotion::landing_friction);
}

constexpr double degrees = 180 / std::numbers::pi;

/// The inputs that are the same along a line of the figure.
using Line = std::tuple<double, double, double>;  // vibration angle and inclination, deg; friction

/// @param with_law  whether the law of rolling layers speaks of any case on this line
std::string curve(Line const& line, bool with_law, double from, double to) {
    constexpr int points = 400;  // finer than a print shows
    auto const [angle, inclination, friction] = line;
    std::string text;
    for (int i = 0; i <= points; ++i) {
        double const gamma = from + (to - from) * i / points;
        theory::PointMass const point{.throw_number = gamma,
                                      .tan_vibration_angle = std::tan(angle / degrees),
                                      .tan_inclination = std::tan(inclination / degrees),
                                      .friction = friction};
        theory::Motion const motion = theory::solve(point);
        if (!motion.converged) continue;
        auto const rolling = with_law ? rolling_efficiency(point, {}) : std::nullopt;
        text += fmt::format("{:.6g},{},{},{},{},{}\n", gamma, angle, inclination, friction,
                            motion.velocity_efficiency, rolling ? fmt::format("{}", *rolling) : "");
    }
    return text;
}

}  // namespace

std::string theory_curves_csv(std::vector<Row> const& rows) {
    std::string text =
        "throw_number,vibration_angle_deg,inclination_deg,friction,velocity_efficiency,rolling_layer_"
        "efficiency\n";
    std::map<Line, bool> lines;
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (Row const& row : rows) {
        if (!(row.vibration_angle_deg > 0)) continue;
        bool& with_law = lines[{row.vibration_angle_deg, row.inclination_deg, row.friction}];
        with_law = with_law || row.efficiency_rolling_layer.has_value();
        least = std::min(least, row.throw_number);
        most = std::max(most, row.throw_number);
    }
    for (auto const& [line, with_law] : lines) text += curve(line, with_law, 0.9 * least, 1.1 * most);
    return text;
}

bool is_bound(Row const& row) {
    return row.numerical_error && !row.numerical_error_case;
}

bool is_borrowed(Row const& row) {
    return row.numerical_error_case && *row.numerical_error_case != row.id;
}

std::optional<std::string> larger_error(Row const& row) {
    if (!row.efficiency_dem_half_width || !row.numerical_error) return {};
    return *row.numerical_error > *row.efficiency_dem_half_width ? "numerical" : "statistical";
}

Row drive_row(std::string const& id, prepare::PreparedCase const& prepared) {
    scenario::Trough const& trough = prepared.scenario.trough;
    Row row{};
    row.id = id;
    if (std::string const open = not_covered(prepared.scenario.engine); !open.empty()) row.not_covered = open;
    if (prepare::is_soft(prepared.scenario)) row.soft = "soft";
    row.throw_number = prepared.throw_number;
    row.machine_number = prepared.machine_number;
    row.vibration_angle_deg = scenario::in_degrees(trough.vibration_angle);
    row.inclination_deg = scenario::in_degrees(trough.inclination);
    row.friction = trough.friction;
    row.amplitude_m = trough.amplitude;
    row.frequency_hz = trough.frequency;
    return row;
}

Row compare(std::string const& id, prepare::PreparedCase const& prepared,
            std::optional<store::CaseRecord> const& record, std::string const& outcome,
            std::optional<MeasuredFriction> const& friction) {
    Row row = drive_row(id, prepared);
    row.outcome = record ? std::string(name_of(record->outcome)) : outcome;
    add_theory(row, prepared.point_mass);
    add_rolling_layer(row, prepared);
    if (friction) add_layer_theory(row, prepared.point_mass, *friction);
    if (record) add_measurement(row, *record, prepared);
    return row;
}

}  // namespace vibrotrough::compare
