#include "deck/drive_checks.hpp"

#include "theory/conveyor.hpp"
#include "theory/unusual.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::deck {
namespace {

/// The key by which the user gave a number that is unusual.
char const* unusual_key(theory::UnusualQuantity quantity, scenario::Trough const& trough) {
    using enum theory::UnusualQuantity;
    bool const is_derived = trough.given.throw_number || trough.given.machine_number;
    char const* const derived = trough.given.throw_number ? "trough.throw_number" : "trough.machine_number";
    switch (quantity) {
        case frequency:
            return is_derived ? derived : "trough.frequency";
        case machine_number:
            if (trough.given.machine_number) return derived;
            [[fallthrough]];
        case amplitude:
            return trough.given.is_stroke ? "trough.stroke" : "trough.amplitude";
        case vibration_angle:
            return trough.given.tan_vibration_angle ? "trough.tan_vibration_angle" : "trough.vibration_angle";
        case friction:
            return "trough.friction";
        case bulk_density:
            return "grains.bulk_density";
        case grain_density:
            return "grains.density";
    }
    return "";
}

/// sum over harmonics of the squares of their accelerations, in units of the fundamental's amplitude.
double acceleration_power(scenario::DriveMotion const& motion, bool of_fundamental) {
    double sum = 0;
    for (auto const* terms : {&motion.along, &motion.normal})
        for (scenario::DriveTerm const& term : *terms)
            if ((term.order == 1) == of_fundamental)
                sum += std::pow(term.amplitude * term.order * term.order, 2);
    return sum;
}

}  // namespace

void check_stroke(std::vector<Finding>& findings, prepare::PreparedCase const& c) {
    scenario::Scenario const& s = c.scenario;
    double const stroke = 2 * s.trough.amplitude * std::cos(s.trough.vibration_angle);
    findings.push_back(most("stroke along the trough / periodic length", "layer.length",
                            stroke / s.layer.length, 1, 2,
                            "lengthen the box: the mesh moves by more than the length of the box"));
}

void check_unusual(std::vector<Finding>& findings, prepare::PreparedCase const& c) {
    scenario::Trough const& trough = c.scenario.trough;
    theory::MachineNumbers numbers{trough.frequency, trough.amplitude, machine_number(trough),
                                   trough.friction, trough.vibration_angle};
    numbers.is_stroke = trough.given.is_stroke;
    numbers.is_turns = trough.given.is_turns;
    if (c.scenario.grains.is_bulk_given) {
        numbers.bulk_density = bulk_density(c.scenario.grains);
    } else {
        numbers.grain_density = c.scenario.grains.density;
        for (scenario::Material const& material : c.materials)
            numbers.grain_density = std::min(*numbers.grain_density, material.grains.density);
    }
    for (theory::UnusualNumber const& one : theory::find_unusual(numbers)) {
        std::string const advice = one.slip.empty() ? one.usual : fmt::format("{}; {}", one.usual, one.slip);
        char const* const key = unusual_key(one.quantity, trough);
        findings.push_back(one.is_too_small() ? least(one.name, key, one.value, one.limit, 0, advice)
                                              : most(one.name, key, one.value, one.limit, never, advice));
        findings.back().unit = one.unit;
    }
}

void check_grip(std::vector<Finding>& findings, prepare::PreparedCase const& c) {
    theory::Conveyor const& conveyor = c.point_mass.conveyor;
    double const slope = std::abs(conveyor.point.tan_inclination);
    double const friction = effective_friction(conveyor).kinetic_friction;
    if (friction >= slope) return;
    findings.push_back(least(
        "friction that holds the layer on its slope", "trough.friction", friction, slope, 0,
        fmt::format(
            "make it less steep: on {:.3g} deg with a friction of {:.3g} a layer without another grip runs "
            "away, and has no mean speed",
            scenario::in_degrees(c.scenario.trough.inclination), friction)));
}

void check_record(std::vector<Finding>& findings, prepare::PreparedCase const& c) {
    if (!c.scenario.trough.waveform) return;
    findings.push_back(
        most("accelerations of the harmonics / of the fundamental (rms)", "trough.waveform",
             std::sqrt(acceleration_power(c.motion, false) / acceleration_power(c.motion, true)), 1, never,
             "look at the record: either the motion has shocks, or noise is taken for motion, and "
             "waveform_order leaves out high harmonics"));
}

}  // namespace vibrotrough::deck
