#include "learn/design_campaign.hpp"

#include "atlas/tables.hpp"
#include "learn/design_details.hpp"
#include "learn/machine_keys.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::learn {
namespace {

/// The section of a campaign that varies the friction, by its median and the ends of its central 95 %, which
/// count as two standard deviations of a normal distribution; empty when they are the same to three digits.
std::string friction_sweep(KnownFriction const& known) {
    std::set<std::string> ends;
    auto const [low, high] =
        known.draws.empty()
            ? theory::Range{std::max(known.low, known.median - 2 * known.sd), known.median + 2 * known.sd}
            : known.central(0.95);
    for (double const mu : {low, high})
        if (fmt::format("{:.3f}", mu) != fmt::format("{:.3f}", known.median))
            ends.insert(fmt::format("{:.3f}", mu));
    if (ends.empty()) return "";
    ends.insert(fmt::format("{:.6g}", known.median));
    return fmt::format("\n[sweep]\n\"trough.friction\" = [{}]\n", fmt::join(ends, ", "));
}

/// Of the grains, what the models take for it: as given, else the middle of what the atlas has.
struct TakenGrains {
    double rolling_friction, friction, restitution;
};

TakenGrains taken_grains(DesignTask const& t) {
    auto const middle = [](atlas::Input input) {
        return between_ends(atlas::inputs()[input].low, atlas::inputs()[input].high).mean;
    };
    return {t.rolling_friction.value_or(unknown_rolling_friction().mean),
            t.grain_friction.value_or(middle(atlas::grain_friction_input)), middle(atlas::restitution_input)};
}

}  // namespace

std::optional<std::string> why_no_campaign(DesignTask const& t, RiskDesign const& d) {
    if (!t.grain_diameter)
        return "the size of the grains is not known, and so not how many of them lie one above the other; "
               "write "
               "--grain-diameter \"3 mm\"";
    double const deep = d.depth / *t.grain_diameter;
    if (deep >= least_simulated_depth * (1 - 1e-9)) return {};
    return fmt::format(
        "its layer of {:.4g} mm is {:.2g} diameters of a grain deep, and layers of {:g} or more can be "
        "simulated",
        1e3 * d.depth, deep, least_simulated_depth);
}

std::string design_campaign(DesignTask const& t, RiskDesign const& d, CheckedLayer const& layer) {
    if (auto const why = why_no_campaign(t, d)) throw std::invalid_argument(*why);
    theory::Drive const& m = d.drive;
    TakenGrains const grains = taken_grains(t);
    auto const why = [](bool is_given) {
        return is_given ? "" : "            # not given: the middle of what was simulated";
    };
    double const mm = 1e3 * *t.grain_diameter, depth = 1e3 * d.depth;
    std::string const rotation =
        grains.rolling_friction > 0
            ? fmt::format("rotation = \"rolling\"\nrolling_friction = {:.6g}{}\n", grains.rolling_friction,
                          why(t.rolling_friction.has_value()))
            : "";
    // Waves and convection need a part that is as long as the layer is deep and as the stroke along the
    // trough.
    double const stroke_along = 2e3 * m.amplitude * std::cos(m.vibration_angle);
    double const length = std::ceil(std::max({layer.box_length * mm, 1.1 * depth, 1.1 * stroke_along}));
    return fmt::format(
        R"(# Checks a design of 'vibrotrough design' with grains: {:.4g} t/h on a trough {:.4g} m wide, layer {:.4g} mm deep.
# The grains are spheres of {:.4g} mm that roll {}; what is assumed of them is said below.
#     vibrotrough check FILE
#     vibrotrough run FILE
#     vibrotrough compare runs/design_check        # mass flow in t/h with its interval

[campaign]
name = "design_check"

[trough]
inclination = "{:.10g} deg"
vibration_angle = "{:.10g} deg"
stroke = "{:.10g} mm"
frequency = "{:.10g} 1/min"
width = "{:.10g} m"
friction = {:.6g}
restitution = {:.6g}                # assumed

[grains]
diameter = "{:.10g} mm"
diameter_spread = 0.1             # assumed
bulk_density = "{:.10g} kg/m3"
poisson_ratio = 0.35
friction = {:.6g}{}
restitution = {:.6g}                # assumed
{}
[layer]
length = "{:.4g} mm"              # of a part of the trough, continued periodically
width = "{:.4g} mm"
height = "{:.10g} mm"

[measure]
packings = 4
half_width = {:.4g}
{})",
        tonnes_per_hour * t.mass_flow, t.width, depth, mm,
        grains.rolling_friction > 0 ? "against rolling friction" : "freely", m.inclination / degree,
        m.vibration_angle / degree, 2e3 * m.amplitude, 60 * m.frequency, t.width, t.friction.median,
        grains.restitution, mm, t.bulk_density, grains.friction, why(t.grain_friction.has_value()),
        grains.restitution, rotation, length, layer.box_width * mm, depth, layer.half_width,
        friction_sweep(t.friction));
}

}  // namespace vibrotrough::learn
