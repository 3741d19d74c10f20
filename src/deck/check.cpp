#include "deck/check.hpp"

#include "deck/drive_checks.hpp"
#include "deck/estimates.hpp"
#include "deck/open_trough.hpp"
#include "deck/trough_mesh.hpp"
#include "prepare/contact.hpp"
#include "scenario/model/softness.hpp"
#include "scenario/model/surface_repair.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include <fmt/format.h>

namespace vibrotrough::deck {
namespace {

bool is_block(scenario::Scenario const& s) {
    return s.layer.block != scenario::Block::none;
}

/// The key that determines the duration of a contact.
char const* stiffness_key(scenario::Scenario const& s) {
    return is_block(s) ? "solver.block_stiffness" : "grains.youngs_modulus";
}

/// eta was measured to be the same at 10, 20, 30 and 40 % of the Rayleigh time. A contact that lasts fewer
/// than ten steps is not resolved (the restitution of an impact is off by 0.02 at 14 steps).
void check_time_step(std::vector<Finding>& findings, prepare::PreparedCase const& c) {
    scenario::Scenario const& s = c.scenario;
    prepare::TimeGrid const& time = c.time;
    // Who left the modulus to the program has none to lower.
    bool const is_chosen = !is_block(s) && s.grains.is_modulus_chosen;
    char const* const key = is_chosen ? "solver.softness" : stiffness_key(s);
    std::string const soften = fmt::format("{} {}", is_chosen ? "raise" : "lower", key);
    if (!is_block(s)) {
        findings.push_back(most("time step / Rayleigh time", "solver.rayleigh_fraction",
                                time.rayleigh_fraction, 0.4, 0.8,
                                "lower it: with too long a step the grains gain energy"));
    }
    findings.push_back(most("time step / contact time at twice the trough's speed", key,
                            time.contact_fraction, 0.101, 0.2,
                            "lower solver.rayleigh_fraction or " + soften));
    findings.push_back(least("steps per cycle", "solver.rayleigh_fraction", time.steps_per_cycle, 500, 100,
                             "lower it, so that the motion of the drive is resolved"));
    findings.push_back(most("steps per cycle, at most", key, time.steps_per_cycle, 1e5, never,
                            soften + " or use larger grains, because the run will take long"));
}

/// Softer grains need fewer time steps, but overlaps of a few percent change the packing, and above about ten
/// percent Hertz's law is not valid. eta changes by 0.03 between E = 1 and 20 MPa, where the overlap at
/// impact decreases from 8 to 2 % of the diameter.
void check_overlaps(std::vector<Finding>& findings, prepare::PreparedCase const& c) {
    scenario::Scenario const& s = c.scenario;
    prepare::TimeGrid const& time = c.time;
    double const diameter = mean_diameter(s);
    std::string const stiffen =
        fmt::format("raise it: the overlap scales as E^(-{:.2g}) at rest and as E^(-0.4) at impact",
                    prepare::contact_of(s, time.impact_speed)->stiffness_exponent());
    findings.push_back(most("overlap under the layer's own weight / diameter", "grains.youngs_modulus",
                            overlap_under(c, bottom_load(c)) / diameter, 0.01, 0.1, stiffen));
    findings.push_back(most("overlap of a grain at impact at twice the trough's speed / diameter",
                            "grains.youngs_modulus", overlap_at_impact(c, time.impact_speed) / diameter, 0.1,
                            0.3, stiffen));
}

/// Attraction of grains. A bond number above 1 is not an error, but the theory knows no attraction. A single
/// grain at rest on the trough is pulled off it with (Gamma - 1) times its weight at most. A layer pulls more
/// at each of its contacts, and was seen to fly at a bond number of 2.9 Gamma.
void check_cohesion(std::vector<Finding>& findings, prepare::PreparedCase const& c) {
    scenario::Scenario const& s = c.scenario;
    if (s.engine.cohesion == 0) return;
    char const* const key = "engine.cohesion";
    if (auto const ratio = attraction_ratio(c)) {
        findings.push_back(
            most("attraction / spring of a contact", key, *ratio, 0.1, 1,
                 "lower it, or write contact = \"hertz\": both are proportional to the overlap, "
                 "so that grains soften but never stick"));
        return;
    }
    double const bond = bond_number(c);
    findings.push_back(
        most("bond number (pull-off force of a grain from the trough / its weight)", key, bond, 1, never,
             "lower it, unless the layer is meant to be cohesive; the pull-off force goes with "
             "the cube of it and with E^(-2)"));
    findings.push_back(most("bond number / throw number", key, bond / c.throw_number, 1, never,
                            "lower it: the trough cannot throw off a single grain that rests on it"));
    findings.push_back(most("overlap by attraction alone / diameter", "grains.youngs_modulus",
                            overlap_under(c, 0) / mean_diameter(s), 0.01, 0.1,
                            "stiffen the grains, and raise the cohesion as E^(2/3) to keep the bond number"));
}

/// Flights shorter than this part of a cycle are not looked at: just above a throw number of 1 the point mass
/// only grazes. In a flight of a tenth of a cycle it rises by 4.5 (Gamma - 1)^2 g cos(alpha) / omega^2, less
/// than a thousandth of the amplitude, because Gamma is 1.012 there (Eq. 15 of Sloot & Kruyt expanded about
/// Gamma = 1: the flight takes 4 sqrt(2 (Gamma - 1)) / omega). There is no flight to resolve.
constexpr double shortest_flight = 0.1;

/// An impact should be short compared with what happens between impacts. A collision passes through the layer
/// grain by grain, which takes the height in diameters times the contact time of a grain.
void check_contact_time(std::vector<Finding>& findings, prepare::PreparedCase const& c) {
    scenario::Scenario const& s = c.scenario;
    prepare::TimeGrid const& time = c.time;
    double const speed = time.impact_speed / 2;
    double const contact = impact_duration(c, speed), cycle = 1 / s.trough.frequency;
    double const layers = is_block(s) ? 1 : std::max(1.0, c.layer_height / mean_diameter(s));
    std::string const key = stiffness_key(s);
    std::string const stiffen = is_block(s) ? "raise it: the contact time is inversely proportional to it"
                                            : "raise it: the contact time scales as E^(-2/5)";
    findings.push_back(
        most("contact time at the trough's speed / cycle", key, contact / cycle, 0.02, 0.1, stiffen));
    double const flight = flight_time(c);
    if (flight < shortest_flight * cycle) return;
    findings.push_back(
        most("contact time at the trough's speed / flight time", key, contact / flight, 0.05, 0.3, stiffen));
    if (is_block(s)) return;
    findings.push_back(most("collision through the layer / flight time", key, layers * contact / flight, 0.3,
                            never, stiffen));
}

/// Measured at throw number 2: lengths of 8, 12 and 24 diameters give eta 0.822, 0.826 and 0.79 to 0.81.
void check_box(std::vector<Finding>& findings, prepare::PreparedCase const& c) {
    scenario::Scenario const& s = c.scenario;
    double const diameter = mean_diameter(s);
    bool const open = is_open(s);
    if (!open) {
        findings.push_back(
            least("periodic length / diameter", "layer.length", s.layer.length / diameter, 8, 4,
                  "lengthen the box, so that grains do not interact with their own periodic images"));
    }
    findings.push_back(least(open ? "width of the trough / diameter" : "periodic width / diameter",
                             "layer.width", s.layer.width / diameter, 5, 4, "widen the box"));
    if (c.clump) {
        // With half the box a grain would lie across from its own image whichever way it turns.
        findings.push_back(most("largest extent of a clump / smaller side of the box", "grains.shape",
                                c.largest_extent / std::min(s.layer.length, s.layer.width), 0.4, 0.5,
                                "lengthen and widen the box, or use a more compact shape"));
    }
    if (open) check_filling(findings, c);
    if (!open)
        findings.push_back(least("periodic length / layer height", "layer.length",
                                 s.layer.length / c.layer_height, 1, 0,
                                 "lengthen the box, because waves and convection in the layer need space"));
    findings.push_back(least("layer height / diameter", "layer.height", c.layer_height / diameter, 1, 0,
                             "use more grains, because these do not form a layer"));
}

/// Grains that are too soft slow a deep layer down (validation/deep_layers). An error when
/// prepare::is_soft().
void check_softness(std::vector<Finding>& findings, prepare::PreparedCase const& c) {
    double const wanted = c.scenario.measure.half_width;
    double const s = scenario::wave_number(c.scenario, *c.scenario.grains.youngs_modulus);
    double const limit = s * std::sqrt(wanted / 2 / c.numerics.softness);
    bool const is_chosen = c.scenario.grains.is_modulus_chosen;
    constexpr double rounding = 1.05;  // at most, to two digits
    std::string advice =
        is_chosen ? fmt::format("lower it to {:.2g}, or allow a half-width of {:.2g}", limit / rounding,
                                2 * rounding * c.numerics.softness)
                  : fmt::format("write at least {:.3g} MPa", scenario::stiff_enough(c.scenario, limit) / 1e6);
    // A cohesion needs the modulus that it was chosen for.
    if (!is_chosen && c.scenario.engine.cohesion == 0)
        advice = "leave out grains.youngs_modulus, so that it is chosen, or " + advice;
    advice += fmt::format(
        ": a landing takes {:.2g} degrees of the cycle to cross the layer (validation/deep_layers)",
        s * 180 / std::numbers::pi);
    findings.push_back(most("error of eta by soft grains",
                            is_chosen ? "solver.softness" : "grains.youngs_modulus", c.numerics.softness,
                            wanted / 2 * (1 + 1e-9), 2 * wanted, advice));
}

/// All numerical errors together must leave something of the interval to statistics. The cure is named for
/// the largest part.
void check_numerics(std::vector<Finding>& findings, prepare::PreparedCase const& c) {
    prepare::NumericalErrors const& numerics = c.numerics;
    double const wanted = c.scenario.measure.half_width;
    bool const is_box = numerics.box >= numerics.softness;
    std::string const advice = fmt::format(
        "the case will probably end as not-precise: {}; or allow a half-width of {:.2g} "
        "(validation/numerics)",
        prepare::how_to_lower(numerics), numerics.total() / prepare::largest_numerical_share);
    findings.push_back(most("all numerical errors of eta", is_box ? "layer.length" : "grains.youngs_modulus",
                            numerics.total(), prepare::largest_numerical_share * wanted * (1 + 1e-9), never,
                            advice));
}

/// The engine's coefficient of restitution is at least 0.05, with which grains come back with 0.214.
void check_restitution(std::vector<Finding>& findings, prepare::PreparedCase const& c) {
    double const lowest = std::min(c.scenario.grains.restitution, c.scenario.trough.restitution);
    if (lowest >= prepare::least_restitution) return;
    findings.push_back(
        least("restitution", "grains.restitution", lowest, prepare::least_restitution, 0,
              "the contact of the engine cannot be less elastic than 0.214, which is simulated"));
}

/// In some codes small grains get caught between much larger ones (engine/README.md).
void check_sizes(std::vector<Finding>& findings, prepare::PreparedCase const& c) {
    double ratio = c.classes.front().diameter / c.classes.back().diameter;
    char const* key = "grains.diameter_spread";
    if (c.scenario.grains.size_law == scenario::SizeLaw::listed) key = "grains.diameters";
    if (c.materials.size() > 1) key = "materials.1.diameter";
    if (c.clump) {
        auto const [small, large] = std::ranges::minmax(c.clump->spheres, {}, &scenario::Sphere::radius);
        ratio *= large.radius / small.radius;
        key = "grains.shape";
    }
    findings.push_back(most(
        "largest sphere / smallest sphere", key, ratio, largest_tried_size_ratio, never,
        "narrow the sizes: small grains between large ones were tried up to this ratio (Vyas et al. 2025 "
        "found codes that fail from about 3 on)"));
}

/// What of the sizes can pass a screen, and whether softness decides about any of them.
void check_screen(std::vector<Finding>& findings, prepare::PreparedCase const& c) {
    if (!has_holes(c.scenario)) return;
    double const opening = *c.scenario.screen.opening;
    double const smallest = c.classes.back().diameter, largest = c.classes.front().diameter;
    findings.push_back(most("smallest grain / opening of the screen", "screen.opening", smallest / opening,
                            1 - 1e-9, never, "widen it: nothing falls through"));
    findings.push_back(least("largest grain / opening of the screen", "screen.opening", largest / opening, 1,
                             0, "all grains can fall through, and nothing is left of a partition curve"));
    double nearest = 1;
    for (prepare::ClassCount const& size : c.classes)
        nearest = std::min(nearest, std::abs(size.diameter / opening - 1));
    findings.push_back(least(
        "size nearest to the opening: difference / overlap at the trough's speed", "grains.youngs_modulus",
        nearest * mean_diameter(c.scenario) / overlap_at_impact(c, c.time.impact_speed / 2), 1, 0,
        "stiffen the grains, or move the size or the opening: grains that are pressed together by so much "
        "can be pushed through holes that are too small for them"));
    if (is_open(c.scenario)) return;
    findings.push_back(least("holes of the screen along the box", "layer.length", c.domain.screen->along, 3,
                             0, "lengthen the box, so that a grain does not meet the same hole again"));
    findings.push_back(least("holes of the screen across the box", "layer.width", c.domain.screen->across, 3,
                             0, "widen the box, so that a grain does not meet the same hole again"));
}

/// A needle of a mesh that cannot be divided into stouter triangles, with its place.
void check_mesh(std::vector<Finding>& findings, prepare::PreparedCase const& c) {
    if (!c.domain.has_mesh()) return;
    scenario::TroughMesh const& mesh = *c.scenario.trough.mesh;
    auto const worst = std::ranges::min_element(mesh.triangles, {}, scenario::smallest_angle);
    auto const number = mesh.numbers[static_cast<std::size_t>(worst - mesh.triangles.begin())];
    auto const [x, y, z] = worst->front();
    findings.push_back(least(
        "smallest angle of a triangle of the mesh", "trough.mesh", smallest_angle_of_mesh(c),
        hard_angle_of_engine, hard_angle_of_engine,
        fmt::format("draw triangle {} with stouter ones, at ({:.4g}, {:.4g}, {:.4g}) {} from the corner of "
                    "the mesh: the engine refuses needles",
                    number, x, y, z, name_of(c.scenario.trough.mesh_unit))));
    findings.back().unit = "deg";
}

/// Air slows down grains that fall slowly in it, and layers of them let hardly any through.
void check_air(std::vector<Finding>& findings, prepare::PreparedCase const& c) {
    constexpr double powder = 0.2e-3;
    double const smallest = c.classes.back().diameter;
    if (smallest >= powder) return;
    findings.push_back(least("diameter of the smallest grains, for which air does not matter",
                             "grains.diameter", 1e3 * smallest, 1e3 * powder, 0,
                             "air is not simulated, and layers of powder on a trough are held back and "
                             "lifted by it; compare with a measurement"));
    findings.back().unit = "mm";
}

/// What nobody waits for is a mistake of units or sizes.
void check_cost(std::vector<Finding>& findings, prepare::PreparedCase const& c) {
    double const hours = expected_work(c, expected_packings(c.scenario)) / usual_speed / 3600;
    findings.push_back(most("core-hours of a case", "layer.grains", hours, 1000, 10'000,
                            "use fewer or larger grains, a shorter box, or softer grains"));
    findings.back().unit = "h";
}

void check_engine(std::vector<Finding>& findings, prepare::PreparedCase const& c) {
    prepare::TimeGrid const& time = c.time;
    bool const has_block = is_block(c.scenario);
    findings.push_back(least("steps between rebuilds of neighbour lists at twice the trough's speed",
                             has_block ? "solver.block_stiffness" : "solver.rayleigh_fraction",
                             steps_between_rebuilds(c, time.impact_speed), 5, 1,
                             fmt::format("{} it, because grains move out of their neighbour lists",
                                         has_block ? "raise" : "lower")));
    bool const has_frames = c.scenario.output.frames_per_cycle > 0;
    char const* const key = has_frames ? "output.frames_per_cycle" : "measure.max_cycles";
    std::string const advice =
        has_frames ? "write fewer frames" : "lower it or measure.max_packings, or use fewer or larger grains";
    constexpr double gigabyte = 1e9;
    for (Finding size : {most("disk", key, expected_bytes(c) / gigabyte, 10, 1000, advice),
                         most("disk, with max_packings packings of max_cycles cycles", key,
                              largest_bytes(c) / gigabyte, 100, never, advice),
                         most("memory of one engine", "layer.grains", expected_memory(c) / gigabyte, 8, 1000,
                              "use fewer grains, or a shorter box")}) {
        size.unit = "GB";
        findings.push_back(size);
    }
}

/// What a check of single contacts finds for a layer of one material. In a mixture it is done for each of
/// them, as if the layer were of this one, and the largest number of each finding counts.
void check_each_material(std::vector<Finding>& findings, prepare::PreparedCase const& c,
                         void (*check_one)(std::vector<Finding>&, prepare::PreparedCase const&)) {
    if (c.materials.size() == 1) return check_one(findings, c);
    std::vector<Finding> worst;
    for (scenario::Material const& material : c.materials) {
        prepare::PreparedCase one = c;
        one.scenario.grains = material.grains;
        one.scenario.materials.clear();
        std::vector<Finding> found;
        check_one(found, one);
        if (worst.empty()) worst = found;
        for (std::size_t i = 0; i < std::min(worst.size(), found.size()); ++i)
            if (found[i].measured > worst[i].measured) worst[i] = found[i];
    }
    findings.insert(findings.end(), worst.begin(), worst.end());
}

/// All checks but those of the whole run, for a drive without stages.
std::vector<Finding> check_drive(prepare::PreparedCase const& prepared) {
    std::vector<Finding> findings;
    check_time_step(findings, prepared);
    if (!is_block(prepared.scenario)) {
        check_each_material(findings, prepared, check_overlaps);
        check_cohesion(findings, prepared);
    }
    check_each_material(findings, prepared, check_contact_time);
    if (!is_block(prepared.scenario)) {
        check_box(findings, prepared);
        check_restitution(findings, prepared);
        check_softness(findings, prepared);
        check_numerics(findings, prepared);
        check_sizes(findings, prepared);
        check_screen(findings, prepared);
    }
    check_stroke(findings, prepared);
    check_record(findings, prepared);
    check_unusual(findings, prepared);
    check_grip(findings, prepared);
    return findings;
}

/// The checks of each stage as if its drive had no end; of each item the worst stage counts.
std::vector<Finding> check_stages(prepare::PreparedCase const& prepared) {
    std::vector<Finding> worst;
    for (std::size_t i = 0; i < prepared.stages.size(); ++i) {
        if (prepared.stages[i].standstill) continue;
        for (Finding& finding : check_drive(of_stage(prepared, prepared.stages[i]))) {
            if (finding.item == filling_item) continue;  // the stages say what is measured
            if (finding.severity != Severity::fine) finding.advice += fmt::format(" (stage {})", i + 1);
            auto const known = std::ranges::find(worst, finding.item, &Finding::item);
            if (known == worst.end()) {
                worst.push_back(std::move(finding));
            } else if (excess(finding) > excess(*known)) {
                *known = std::move(finding);
            }
        }
    }
    return worst;
}

}  // namespace

std::string to_string(Severity severity) {
    constexpr std::array names{"fine", "warning", "error"};
    return names.at(static_cast<std::size_t>(severity));
}

double excess(Finding const& finding) {
    return finding.at_least ? finding.limit / finding.measured : finding.measured / finding.limit;
}

std::vector<Finding> check(prepare::PreparedCase const& prepared) {
    std::vector<Finding> findings = prepared.stages.empty() ? check_drive(prepared) : check_stages(prepared);
    check_mesh(findings, prepared);
    check_air(findings, prepared);
    check_cost(findings, prepared);
    check_engine(findings, prepared);
    return findings;
}

}  // namespace vibrotrough::deck
