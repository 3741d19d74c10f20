#include "store/layer_schema.hpp"

#include "measure/mass_flow.hpp"

#include <algorithm>
#include <cmath>

namespace vibrotrough::store {
namespace {

using Case = CaseRecord const&;
using Packing = PackingRecord const&;
using Real = std::optional<double> (*)(Case);
using Integer = int (*)(Case);

/// The mean over the packings that have this number; none when no packing has it.
template <class Value>
std::optional<double> mean(Case record, Value const& value_of) {
    double sum = 0;
    int count = 0;
    for (Packing packing : record.packings) {
        std::optional<double> const value = value_of(packing);
        if (!value) continue;
        sum += *value;
        ++count;
    }
    if (count == 0) return {};
    return sum / count;
}

template <class Value>
std::optional<double> largest(Case record, Value const& value_of) {
    std::optional<double> most;
    for (Packing packing : record.packings) {
        std::optional<double> const value = value_of(packing);
        if (value) most = std::max(most.value_or(*value), *value);
    }
    return most;
}

int longest_period(Case record) {
    int longest = 0;
    for (Packing packing : record.packings) longest = std::max(longest, packing.motion.period_cycles);
    return longest;
}

/// Dissipation over the kinetic energy scale of the layer, m (omega r)^2.
std::optional<double> relative_dissipation(Packing packing, scenario::Trough const& trough) {
    if (!packing.motion.dissipation) return {};
    double const speed = angular_frequency(trough) * trough.amplitude;
    return *packing.motion.dissipation / (packing.mass * speed * speed);
}

/// Half-width of Student's interval of the mean over the packings that have this number; none with fewer than
/// two.
template <class Value>
std::optional<double> half_width(Case record, Value const& value_of) {
    std::vector<double> values;
    for (Packing packing : record.packings) {
        if (std::optional<double> const value = value_of(packing)) values.push_back(*value);
    }
    return measure::student_half_width(values, record.scenario.measure.confidence);
}

std::optional<double> scaled(double factor, std::optional<double> const& value) {
    if (!value) return {};
    return factor * *value;
}

/// None when no mean is known.
std::optional<double> gravity_power(Case record) {
    if (record.packings.empty() || !record.estimate.mean) return {};
    scenario::Trough const& trough = record.scenario.trough;
    return -record.packings.front().mass * scenario::gravity * std::sin(trough.inclination) *
           *record.estimate.mean * velocity_scale(trough);
}

std::optional<double> per_area(Case record, std::optional<double> const& value) {
    if (!value) return {};
    return *value / (record.scenario.layer.length * record.scenario.layer.width);
}

}  // namespace

std::vector<CaseValue> layer_case_values() {
    return {
        {{"added_mass", "kg",
          "Mass that the layer adds to the trough, from the first harmonic of its force in phase with the "
          "acceleration; may be negative; mean over the packings"},
         Real([](Case c) { return mean(c, [](Packing p) { return p.motion.added_mass; }); })},
        {{"damping", "kg/s",
          "Damping that the layer adds to the trough, from the first harmonic of its force in phase with the "
          "velocity; mean over the packings"},
         Real([](Case c) { return mean(c, [](Packing p) { return p.motion.damping; }); })},
        {{"power_per_area", "W/m2",
          "Mean power of the trough on the layer over the area of trough; mean over the packings"},
         Real([](Case c) { return per_area(c, mean(c, [](Packing p) { return p.motion.trough_power; })); })},
        {{"period_cycles", "1",
          "Cycles after which the layer's motion repeats, 1 to 8, the most of any packing"},
         Integer(longest_period)},
        {{"take_off_phase", "rad",
          "Phase at which the layer takes off for its longest flight; NaN without flight; mean over the "
          "packings"},
         Real([](Case c) { return mean(c, [](Packing p) { return p.motion.take_off_phase; }); })},
        {{"landing_phase", "rad",
          "Phase at which it lands, above take_off_phase; NaN without flight; mean over the packings"},
         Real([](Case c) { return mean(c, [](Packing p) { return p.motion.landing_phase; }); })},
        {{"flight_number", "1",
          "Duration of the longest flight in cycles, 0 without flight; mean over the packings"},
         Real([](Case c) { return mean(c, [](Packing p) { return p.motion.flight_number; }); })},
        {{"effective_restitution", "1",
          "Bulk restitution: largest rising speed of the centre of mass relative to the trough between "
          "landing and next take-off over its falling speed before landing; NaN without landings; mean over "
          "the packings"},
         Real([](Case c) { return mean(c, [](Packing p) { return p.motion.restitution; }); })},
        {{"coordination_number", "1",
          "Mean contacts per grain, with other grains (counted for both) and with the floor, over the cycle; "
          "NaN without measure.rolling; mean over the packings"},
         Real([](Case c) { return mean(c, [](Packing p) { return p.rolling.coordination_number; }); })},
        {{"coordination_number_half_width", "1",
          "Half-width of its interval at measure.confidence, Student's t over the packings; NaN with one "
          "packing"},
         Real([](Case c) { return half_width(c, [](Packing p) { return p.rolling.coordination_number; }); })},
        {{"gravity_power", "W",
          "Mean power of gravity on the conveyed layer, negative uphill: - m g sin(alpha) times the "
          "conveying "
          "speed"},
         Real(gravity_power)},
        {{"dissipated_power", "W",
          "Dissipation times frequency; of a steady layer it is the power of the trough and of gravity"},
         Real([](Case c) {
             return scaled(c.scenario.trough.frequency,
                           mean(c, [](Packing p) { return p.motion.dissipation; }));
         })},
        {{"dissipation", "J",
          "Energy dissipated per cycle: work of trough and gravity on the layer less its gain of kinetic "
          "energy; mean over the packings"},
         Real([](Case c) { return mean(c, [](Packing p) { return p.motion.dissipation; }); })},
        {{"dissipation_fraction", "1", "Dissipation over m (omega r)^2; mean over the packings"},
         Real([](Case c) {
             return mean(c, [&c](Packing p) { return relative_dissipation(p, c.scenario.trough); });
         })},
        {{"floor_slip", "m/s",
          "Slip speed of the touching grains' surface on the floor, mean over grains and phases of its "
          "magnitude; mean over the packings"},
         Real([](Case c) { return mean(c, [](Packing p) { return p.motion.floor_slip; }); })},
        {{"friction_ratio", "1",
          "Tangential over normal force while the layer slides, apart from the ends of slides; NaN without "
          "slides; mean over the packings"},
         Real([](Case c) { return mean(c, [](Packing p) { return p.motion.friction_ratio; }); })},
        {{"landing_friction", "1",
          "Tangential over normal impulse of the layer on the trough from its landing until its centre of "
          "mass no longer falls against the trough; NaN without landings and with side walls; mean over the "
          "packings"},
         Real([](Case c) { return mean(c, [](Packing p) { return p.motion.landing_friction; }); })},
        {{"efficiency_by_normal_force", "1",
          "Velocity efficiency of a point mass with Coulomb friction under the layer's own normal force; NaN "
          "with side walls; mean over the packings"},
         Real([](Case c) { return mean(c, [](Packing p) { return p.motion.efficiency_by_normal_force; }); })},
        {{"largest_overlap", "m", "Largest overlap of two grains; the largest of any packing"},
         Real([](Case c) { return largest(c, [](Packing p) { return p.motion.largest_overlap; }); })},
        {{"largest_floor_overlap", "m",
          "Largest overlap of a grain and the floor; the largest of any packing"},
         Real([](Case c) { return largest(c, [](Packing p) { return p.motion.largest_floor_overlap; }); })},
        {{"velocity_gradient", "1",
          "Velocity along the trough of the upper third of the layer less that of the lower third, over the "
          "conveying speed; NaN when it is not conveyed; mean over the packings"},
         Real([](Case c) { return mean(c, [](Packing p) { return p.profiles.velocity_gradient; }); })},
        {{"wiggle_amplitude", "m",
          "Amplitude of a sinusoid with the variance of the surface's height along the trough, root mean "
          "square over the snapshots; mean over the packings"},
         Real([](Case c) { return mean(c, [](Packing p) { return p.surface.wiggle_amplitude; }); })},
    };
}

std::vector<PackingValue> layer_packing_values() {
    return {
        {{"added_mass", "kg",
          "Mass that the layer adds to the trough, from the first harmonic of its force in phase with the "
          "acceleration; may be negative"},
         packing_field([](auto& p) -> auto& { return p.motion.added_mass; }),
         true},
        {{"damping", "kg/s",
          "Damping that the layer adds to the trough, from the first harmonic of its force in phase with the "
          "velocity"},
         packing_field([](auto& p) -> auto& { return p.motion.damping; }),
         true},
        {{"trough_power", "W", "Mean power of the trough on the layer"},
         packing_field([](auto& p) -> auto& { return p.motion.trough_power; }),
         true},
        {{"layer_mode", "1", "The bulk's mode in the theory's letters, read from the mean curves in phases"},
         packing_field([](auto& p) -> auto& { return p.motion.mode; })},
        {{"period_cycles", "1", "Cycles after which the layer's motion repeats, 1 to 8"},
         packing_field([](auto& p) -> auto& { return p.motion.period_cycles; })},
        {{"take_off_phase", "rad",
          "Phase at which the layer takes off for its longest flight; NaN without flight"},
         packing_field([](auto& p) -> auto& { return p.motion.take_off_phase; })},
        {{"landing_phase", "rad", "Phase at which it lands, above take_off_phase; NaN without flight"},
         packing_field([](auto& p) -> auto& { return p.motion.landing_phase; })},
        {{"flight_number", "1", "Duration of the longest flight in cycles, 0 without flight"},
         packing_field([](auto& p) -> auto& { return p.motion.flight_number; })},
        {{"effective_restitution", "1",
          "Bulk restitution: largest rising speed of the centre of mass relative to the trough between "
          "landing and next take-off over its falling speed before landing; NaN without landings"},
         packing_field([](auto& p) -> auto& { return p.motion.restitution; })},
        {{"dissipation", "J",
          "Energy dissipated per cycle: work of trough and gravity on the layer less its gain of kinetic "
          "energy"},
         packing_field([](auto& p) -> auto& { return p.motion.dissipation; })},
        {{"floor_slip", "m/s",
          "Slip speed of the touching grains' surface on the floor, mean over grains and phases of its "
          "magnitude"},
         packing_field([](auto& p) -> auto& { return p.motion.floor_slip; })},
        {{"friction_ratio", "1",
          "Tangential over normal force while the layer slides, apart from the ends of slides; NaN without "
          "slides"},
         packing_field([](auto& p) -> auto& { return p.motion.friction_ratio; })},
        {{"landing_friction", "1",
          "Tangential over normal impulse of the layer on the trough from its landing until its centre of "
          "mass no longer falls against the trough; NaN without landings and with side walls"},
         packing_field([](auto& p) -> auto& { return p.motion.landing_friction; })},
        {{"efficiency_by_normal_force", "1",
          "Velocity efficiency of a point mass with Coulomb friction under the layer's own normal force; NaN "
          "with side walls"},
         packing_field([](auto& p) -> auto& { return p.motion.efficiency_by_normal_force; })},
        {{"largest_overlap", "m", "Largest overlap of two grains"},
         packing_field([](auto& p) -> auto& { return p.motion.largest_overlap; })},
        {{"largest_floor_overlap", "m", "Largest overlap of a grain and the floor"},
         packing_field([](auto& p) -> auto& { return p.motion.largest_floor_overlap; })},
        {{"velocity_gradient", "1",
          "Velocity along the trough of the upper third of the layer less that of the lower third, over the "
          "conveying speed; NaN when it is not conveyed"},
         packing_field([](auto& p) -> auto& { return p.profiles.velocity_gradient; })},
        {{"wiggle_amplitude", "m",
          "Amplitude of a sinusoid with the variance of the surface's height along the trough, root mean "
          "square over the snapshots"},
         packing_field([](auto& p) -> auto& { return p.surface.wiggle_amplitude; })},
        {{"coordination_number", "1",
          "Mean contacts per grain, with other grains (counted for both) and with the floor, over the cycle; "
          "NaN without measure.rolling"},
         packing_field([](auto& p) -> auto& { return p.rolling.coordination_number; }),
         true},
        {{"rolling_problem", "1",
          "Why the table rolling is empty although measure.rolling asks for it; else empty"},
         packing_field([](auto& p) -> auto& { return p.rolling_problem; }),
         true},
    };
}

std::vector<PackingTable> const& packing_tables() {
    static std::vector<PackingTable> const tables{
        {"phases",
         {"phase", "rad",
          "Phase omega t since the drive's phase 0, at the end of each hundredth of a cycle; over one period "
          "of the layer's motion"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.phase; })},
        {"phases",
         {"displacement", "m", "Displacement of the centre of mass against the trough since phase 0"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.displacement; })},
        {
            "phases",
            {"height", "m", "Height of the centre of mass above the trough"},
            packing_field([](auto& p) -> auto& { return p.motion.curves.height; }),
        },
        {
            "phases",
            {"velocity_x", "m/s", "Velocity of the centre of mass along the trough"},
            packing_field([](auto& p) -> auto& { return p.motion.curves.velocity_x; }),
        },
        {"phases",
         {"velocity_z", "m/s", "Velocity of the centre of mass normal to the trough"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.velocity_z; })},
        {
            "phases",
            {"trough_velocity_x", "m/s", "Velocity of the trough along x"},
            packing_field([](auto& p) -> auto& { return p.motion.curves.trough_velocity_x; }),
        },
        {
            "phases",
            {"trough_velocity_z", "m/s", "Velocity of the trough along z"},
            packing_field([](auto& p) -> auto& { return p.motion.curves.trough_velocity_z; }),
        },
        {"phases",
         {"normal_force", "N",
          "Force of the layer on the trough, normal, positive when pressing; mean over the hundredth that "
          "ends"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.normal_force; })},
        {"phases",
         {"tangential_force", "N",
          "Force of the layer on the trough along x; mean over the hundredth that ends"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.tangential_force; })},
        {"phases",
         {"floor_force", "N", "The part of normal_force that the floor carries, not side walls"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.floor_force; })},
        {"phases",
         {"touching", "1", "Number of grains (of clumps: spheres) whose lowest point is below the floor"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.touching; })},
        {"phases",
         {"airborne", "1", "Fraction of the periods in which nothing touches the trough"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.airborne; })},
        {"phases",
         {"clearance", "m", "Gap between floor and lowest grain; negative: overlap"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.clearance; })},
        {"phases",
         {"slip", "m/s",
          "Slip of the touching grains' surface on the floor, v_x - omega_y R - V, mean over them; NaN where "
          "none touches"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.slip; })},
        {
            "phases",
            {"sliding", "m/s", "The same without their rotation, v_x - V"},
            packing_field([](auto& p) -> auto& { return p.motion.curves.sliding; }),
        },
        {
            "phases",
            {"energy_translation", "J", "Kinetic energy of the grains' translation"},
            packing_field([](auto& p) -> auto& { return p.motion.curves.energy_translation; }),
        },
        {
            "phases",
            {"energy_rotation", "J", "Kinetic energy of the grains' rotation"},
            packing_field([](auto& p) -> auto& { return p.motion.curves.energy_rotation; }),
        },
        {
            "phases",
            {"overlap", "m", "Largest overlap of two grains in any of the periods"},
            packing_field([](auto& p) -> auto& { return p.motion.curves.overlap; }),
        },
        {"phases",
         {"displacement_deviation", "m", "Standard deviation of displacement over the periods"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.displacement_deviation; })},
        {
            "phases",
            {"height_deviation", "m", "Standard deviation of height over the periods"},
            packing_field([](auto& p) -> auto& { return p.motion.curves.height_deviation; }),
        },
        {"phases",
         {"velocity_x_deviation", "m/s", "Standard deviation of velocity_x over the periods"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.velocity_x_deviation; })},
        {"phases",
         {"velocity_z_deviation", "m/s", "Standard deviation of velocity_z over the periods"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.velocity_z_deviation; })},
        {"phases",
         {"normal_force_deviation", "N", "Standard deviation of normal_force over the periods"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.normal_force_deviation; })},
        {"phases",
         {"tangential_force_deviation", "N", "Standard deviation of tangential_force over the periods"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.tangential_force_deviation; })},
        {"phases",
         {"touching_deviation", "1", "Standard deviation of touching over the periods"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.touching_deviation; })},
        {"profiles", {"phase", "rad", "Phase of the snapshot"}, packing_field([](auto& p) -> auto& {
             return p.profiles.phase;
         })},
        {
            "profiles",
            {"height", "m", "Middle of the bin above the trough"},
            packing_field([](auto& p) -> auto& { return p.profiles.height; }),
        },
        {"profiles",
         {"solid_fraction", "1",
          "Volume of the grains with their centres in the bin over its volume, mean over the snapshots"},
         packing_field([](auto& p) -> auto& { return p.profiles.solid_fraction; })},
        {"profiles",
         {"velocity_x", "m/s",
          "Their mean velocity along the trough, relative to it; NaN where no grain ever was"},
         packing_field([](auto& p) -> auto& { return p.profiles.velocity_x; })},
        {"profiles",
         {"velocity_z", "m/s",
          "Their mean velocity normal to the trough, relative to it; NaN where no grain ever was"},
         packing_field([](auto& p) -> auto& { return p.profiles.velocity_z; })},
        {"surface", {"phase", "rad", "Phase of the snapshot"}, packing_field([](auto& p) -> auto& {
             return p.surface.phase;
         })},
        {"surface", {"x", "m", "Middle of the column along the trough"}, packing_field([](auto& p) -> auto& {
             return p.surface.x;
         })},
        {"surface",
         {"height", "m",
          "Surface above the trough, twice the mean height of the column's grains, in the last snapshot of "
          "that phase; NaN without a grain"},
         packing_field([](auto& p) -> auto& { return p.surface.height; })},
    };
    return tables;
}

}  // namespace vibrotrough::store
