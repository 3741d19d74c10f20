#include "store/layer_quantities.hpp"

#include "measure/mass_flow.hpp"

#include <cmath>

namespace vibrotrough::store {
namespace {

using Case = CaseRecord const&;
using Packing = PackingRecord const&;
using Real = Quantity::Real;
using Motion = measure::LayerMotion;
using enum OverPackings;

template <typename Value>
auto motion(Value Motion::*member) {
    return field(&PackingRecord::motion, member);
}

std::optional<double> scaled(double factor, std::optional<double> const& value) {
    if (!value) return {};
    return factor * *value;
}

double area_of(Case record) {
    return record.scenario.layer.length * record.scenario.layer.width;
}

/// The mean over the packings, per area of trough.
Real per_area(MeasuredNumber const& number) {
    return [number](Case record) -> std::optional<double> {
        auto const mean = mean_over_packings(record, number);
        if (!mean) return {};
        return *mean / area_of(record);
    };
}

/// The mean over the packings of the dissipation over the kinetic energy scale of the layer, m (omega r)^2.
std::optional<double> dissipation_fraction(Case record) {
    scenario::Trough const& trough = record.scenario.trough;
    double const speed = angular_frequency(trough) * trough.amplitude;
    double sum = 0;
    int count = 0;
    for (Packing packing : record.packings) {
        if (!packing.motion.dissipation) continue;
        sum += *packing.motion.dissipation / (packing.mass * speed * speed);
        ++count;
    }
    if (count == 0) return {};
    return sum / count;
}

/// kg, of the layer; none of a batch on a screen, which becomes less.
std::optional<double> conveyed_mass(Case record) {
    if (is_open(record.scenario))
        return mean_over_packings(record, field(&PackingRecord::open, &measure::OpenFlow::hold_up));
    if (record.packings.empty() || is_batch(record.scenario)) return {};
    return record.packings.front().mass;
}

/// None when no mean is known.
std::optional<double> gravity_power(Case record) {
    auto const mass = conveyed_mass(record);
    if (!mass || !record.estimate.mean) return {};
    scenario::Trough const& trough = record.scenario.trough;
    return -*mass * trough.gravity * std::sin(trough.inclination) * *record.estimate.mean *
           velocity_scale(trough);
}

/// The direction of the sum of the packings' unit vectors: a phase just before a cycle's end and one just
/// after its beginning are close.
std::optional<double> mean_take_off(Case record) {
    double along = 0, across = 0;
    for (Packing packing : record.packings) {
        if (!packing.motion.take_off_phase) continue;
        along += std::cos(*packing.motion.take_off_phase);
        across += std::sin(*packing.motion.take_off_phase);
    }
    if (along == 0 && across == 0) return {};
    return measure::within_turn(std::atan2(across, along));
}

/// Above the mean take-off, by the mean of what lies between the two in each packing.
std::optional<double> mean_landing(Case record) {
    auto const take_off = mean_take_off(record);
    if (!take_off) return {};
    double sum = 0;
    int count = 0;
    for (Packing packing : record.packings) {
        if (!packing.motion.take_off_phase || !packing.motion.landing_phase) continue;
        sum += *packing.motion.landing_phase - *packing.motion.take_off_phase;
        ++count;
    }
    if (count == 0) return {};
    return *take_off + sum / count;
}

std::optional<double> added_mass_fraction(Case record) {
    auto const added = mean_over_packings(record, motion(&Motion::added_mass));
    if (!added) return {};
    return *added / (mass_per_area(record.scenario) * area_of(record));
}

std::vector<Quantity> machine_quantities() {
    return {
        {"added_mass", "kg",
         "Mass that the layer adds to the trough, from the first harmonic of its force in phase with the "
         "acceleration; may be negative",
         motion(&Motion::added_mass), mean},
        {"damping", "kg/s",
         "Damping that the layer adds to the trough, from the first harmonic of its force in phase with the "
         "velocity",
         motion(&Motion::damping), mean},
        {"trough_power", "W", "Mean power of the trough on the layer", motion(&Motion::trough_power)},
        {"power_per_area",
         "W/m2",
         "Mean power of the trough on the layer over the area of trough; mean over the packings",
         per_area(motion(&Motion::trough_power)),
         nothing,
         {{.format = "{:.3g}", .report = ReportView{"power per area"}}}},
        {"added_mass_per_area",
         "kg/m2",
         "Mean of added_mass over the area of trough",
         per_area(motion(&Motion::added_mass)),
         nothing,
         {{}}},
        {"added_mass_fraction",
         "1",
         "Mean of added_mass over the mass of the layer: 1 when the layer moves as a part of the trough",
         Real(added_mass_fraction),
         nothing,
         {{.format = "{:.3f}", .report = ReportView{"added mass / mass"}}}},
        {"damping_per_area",
         "N s/m3",
         "Mean of damping over the area of trough",
         per_area(motion(&Motion::damping)),
         nothing,
         {{.format = "{:.3g}", .report = ReportView{"damping per area"}}}},
    };
}

std::vector<Quantity> temperature_quantities() {
    std::vector<Quantity> rows;
    add_measured(
        rows, field(&PackingRecord::granular_temperature),
        {"granular_temperature", "granular_temperature_half_width"}, "m2/s2",
        "Granular temperature: a third of the mean square of the grains' velocities relative to the "
        "mean in their slab of one diameter, mean over ten phases of the cycle; the peak of a landing "
        "is shorter than their distance, so that other phases can give several times as much; NaN "
        "with clumps and several materials",
        {.format = "{:.3g}"});
    for (Quantity& row : rows) row.known_without_mean = false;
    return rows;
}

std::vector<Quantity> motion_quantities() {
    return {
        {"layer_mode", "1", "The bulk's mode in the theory's letters, read from the mean curves in phases",
         motion(&Motion::mode)},
        {"period_cycles", "1", "Cycles after which the layer's motion repeats, 1 to 8",
         motion(&Motion::period_cycles), largest},
        {"take_off_phase", "rad",
         "Phase at which the layer takes off for its longest flight; NaN without flight",
         motion(&Motion::take_off_phase)},
        {"take_off_phase", "rad",
         "Phase at which the layer takes off for its longest flight, [0, 2 pi); NaN without flight; mean "
         "direction over the packings, atan2 of the sums of sine and cosine",
         Real(mean_take_off)},
        {"landing_phase", "rad", "Phase at which it lands, above take_off_phase; NaN without flight",
         motion(&Motion::landing_phase)},
        {"landing_phase", "rad",
         "Phase at which it lands: take_off_phase and the mean over the packings of the flight's phases, so "
         "that it may be above 2 pi; NaN without flight",
         Real(mean_landing)},
        {"flight_number", "1", "Duration of the longest flight in cycles, 0 without flight",
         motion(&Motion::flight_number), mean},
        {"effective_restitution", "1",
         "Bulk restitution: largest rising speed of the centre of mass relative to the trough between "
         "landing and next take-off over its falling speed before landing; NaN without landings, and above "
         "1, "
         "where it measures how the trough throws the layer again and not how the layer rebounds",
         motion(&Motion::restitution), mean},
        {"gravity_power", "W",
         "Mean power of gravity on the conveyed layer, negative uphill: - m g sin(alpha) times the conveying "
         "speed, with m = hold_up in an open trough; NaN for a batch on a screen",
         Real(gravity_power)},
        {"dissipated_power", "W",
         "Dissipation times frequency; of a steady layer it is the power of the trough and of gravity",
         Real([](Case c) {
             return scaled(c.scenario.trough.frequency, mean_over_packings(c, motion(&Motion::dissipation)));
         })},
        {"dissipation", "J",
         "Energy dissipated per cycle: work of trough and gravity on the layer less its gain of kinetic "
         "energy",
         motion(&Motion::dissipation), mean},
        {"dissipation_fraction", "1", "Dissipation over m (omega r)^2; mean over the packings",
         Real(dissipation_fraction)},
    };
}

std::vector<Quantity> contact_quantities() {
    return {
        {"floor_slip", "m/s",
         "Slip speed of the touching grains' surface on the floor, mean over grains and phases of its "
         "magnitude",
         motion(&Motion::floor_slip), mean},
        {"friction_ratio", "1",
         "Tangential over normal force while the layer slides, apart from the ends of slides; NaN without "
         "slides",
         motion(&Motion::friction_ratio), mean},
        {"landing_friction",
         "1",
         "Tangential over normal impulse of the layer on the trough from its landing until its centre of "
         "mass no longer falls against the trough; NaN without landings and with side walls",
         motion(&Motion::landing_friction),
         mean,
         {{}}},
        {"largest_overlap", "m", "Largest overlap of two grains", motion(&Motion::largest_overlap), largest},
        {"largest_floor_overlap", "m", "Largest overlap of a grain and the floor",
         motion(&Motion::largest_floor_overlap), largest},
        {"velocity_gradient", "1",
         "Velocity along the trough of the upper third of the layer's mass less that of the lower third, "
         "over the conveying speed; NaN when it is not conveyed",
         field(&PackingRecord::profiles, &measure::Profiles::velocity_gradient), mean},
        {"wiggle_amplitude", "m",
         "Amplitude of a sinusoid with the variance of the surface's height along the trough, root mean "
         "square over the snapshots",
         field(&PackingRecord::surface, &measure::Surface::wiggle_amplitude), mean},
    };
}

}  // namespace

std::vector<Quantity> layer_quantities() {
    std::vector<Quantity> all;
    for (auto const& part :
         {machine_quantities(), motion_quantities(), temperature_quantities(), contact_quantities()})
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace vibrotrough::store
