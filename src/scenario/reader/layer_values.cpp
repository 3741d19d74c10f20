#include "scenario/reader/given_values.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

constexpr double most_spheres = 1e8;  // of a layer
constexpr double most_grains_on_floor = 1e6;

[[noreturn]] void fail_mesh(Scenario const& scenario, GivenKeys const& given, std::string_view wrong,
                            std::string_view instead) {
    given.fail("trough.mesh", fmt::format("{}: {}", scenario.trough.mesh->names(), wrong), instead);
}

/// The ends and the sides of a mesh must fit to those of their periodic images, or the sides must be upright
/// walls.
void check_periodic_mesh(Scenario const& scenario, GivenKeys const& given) {
    TroughMesh const& mesh = *scenario.trough.mesh;
    double const unit = metres_in(scenario.trough.mesh_unit), allowed = 0.01 * smallest_diameter(scenario);
    auto const [start, end] = mesh.has_end_plates;
    if (start || end)
        fail_mesh(scenario, given, "there is an upright plate in one of its ends, which are joined",
                  "remove it");
    if (unit * mesh.mismatch_along > allowed) {
        fail_mesh(scenario, given,
                  fmt::format("its two ends along the trough differ by {} in height, but the box is periodic",
                              given.text("layer.length", unit * mesh.mismatch_along)),
                  "make both ends the same: a step down needs a rise of the same height; or write a section "
                  "[feed], for an open trough");
    }
    if (unit * mesh.mismatch_across > allowed && !mesh.has_upright_sides) {
        fail_mesh(scenario, given,
                  fmt::format("its two sides differ by {} in height, but the box is periodic across",
                              given.text("layer.width", unit * mesh.mismatch_across)),
                  "make both sides the same, or put upright walls there");
    }
}

/// An open trough has a back wall of its own.
void check_open_mesh(Scenario const& scenario, GivenKeys const& given) {
    if (scenario.trough.mesh->has_end_plates[0])
        fail_mesh(
            scenario, given,
            "there is an upright plate in its first end, where an open trough has a back wall of its own",
            "remove it");
}

/// @param extent  m, of the mesh in its unit
std::string advice_on_side(char const* side, double given_side, double extent, MeshUnit unit) {
    for (MeshUnit const other : {MeshUnit::mm, MeshUnit::m, MeshUnit::cm, MeshUnit::inch})
        if (std::abs(extent * metres_in(other) / metres_in(unit) / given_side - 1) < 1e-3)
            return fmt::format("write mesh_unit = \"{}\"", name_of(other));
    return fmt::format("write {} = \"{:.9g} mm\", or is mesh_unit wrong?", side, 1e3 * extent);
}

/// The floor of a mesh need not be level.
void check_mesh(Scenario const& scenario, GivenKeys const& given) {
    TroughMesh const& mesh = *scenario.trough.mesh;
    double const unit = metres_in(scenario.trough.mesh_unit);
    auto const fail = [&](std::string_view wrong, std::string_view instead) {
        fail_mesh(scenario, given, wrong, instead);
    };
    auto const check_side = [&](char const* side, char const* adjective, double given_side, double extent) {
        if (std::abs(given_side - extent) <= 1e-6 * extent) return;
        fail(fmt::format("it is {} {}, and {} is {}", given.text(side, extent), adjective, side,
                         given.text(side, given_side)),
             advice_on_side(side, given_side, extent, scenario.trough.mesh_unit));
    };
    check_side("layer.length", "long", scenario.layer.length, unit * mesh.extent[0]);
    check_side("layer.width", "wide", scenario.layer.width, unit * mesh.extent[1]);
    if (auto const hole = mesh.hole()) {
        fail(fmt::format(
                 "there is a hole in plan at x = {}, y = {} from its corner, through which grains would fall",
                 given.text("layer.length", unit * (*hole)[0]), given.text("layer.width", unit * (*hole)[1])),
             "close it: the surface must cover its length and width; a flat floor with square holes is a "
             "[screen]");
    }
    double const size = smallest_diameter(scenario);
    given.require_at_most("trough.mesh", mesh.area * unit * unit / (size * size), most_grains_on_floor,
                          "grains on its surface",
                          "take a smaller piece of the trough or larger grains; is mesh_unit right?");
    is_open(scenario) ? check_open_mesh(scenario, given) : check_periodic_mesh(scenario, given);
}

/// The key by which the height of the layer was given.
char const* height_key(GivenKeys const& given) {
    return given.has("layer.diameters") ? "layer.diameters" : "layer.height";
}

/// Volume between the mesh and a level above its lowest point, m^3.
double space_below(double height, Scenario const& scenario) {
    double const unit = metres_in(scenario.trough.mesh_unit);
    return scenario.trough.mesh->volume_below(height / unit) * unit * unit * unit;
}

int grains_for(double height, Scenario const& scenario, GivenKeys const& given) {
    given.require(height_key(given), height, mean_diameter(scenario), "one grain diameter");
    double const space = scenario.trough.mesh ? space_below(height, scenario)
                                              : scenario.layer.length * scenario.layer.width * height;
    double const count = settled_solid_fraction * space / mean_grain_volume(scenario);
    if (count < 1)
        given.fail(
            height_key(given),
            fmt::format("{} leaves no room for a grain above the trough", given.text("layer.height", height)),
            "raise it");
    given.require_at_most(height_key(given), count, find_key("layer.grains")->most, "grains",
                          "make the layer smaller or the grains larger");
    return std::max(1, static_cast<int>(std::lround(count)));
}

/// The number of grains that the feed will probably keep in the trough.
int grains_of_feed(Scenario const& s, GivenKeys const& given) {
    double mass = s.stages.empty() ? *s.feed.mass_flow * s.layer.length / expected_speed(s) : 0;
    for (Stage const& stage : stages(s)) {
        if (stage.standstill) continue;
        Scenario driven = s;
        driven.trough = stage.trough;
        mass = std::max(mass, stage.mass_flow * s.layer.length / expected_speed(driven));
    }
    double const count = mass / (mean_density(s) * mean_grain_volume(s));
    given.require_at_most("feed.mass_flow", count, find_key("layer.grains")->most, "grains in the trough",
                          "shorten the trough, feed less, or take larger grains");
    return std::max(1, static_cast<int>(std::lround(count)));
}

/// The mass flow of grains per second.
void weigh_feed(Scenario& s, GivenKeys const& given) {
    if (!s.feed.grains_per_second) return;
    Key const& key = *find_key("feed.mass_flow");
    s.feed.mass_flow = *s.feed.grains_per_second * mean_density(s) * mean_grain_volume(s);
    if (*s.feed.mass_flow >= key.least && *s.feed.mass_flow <= key.most) return;
    given.fail(key.path, fmt::format("{:g} grains per second are out of range", *s.feed.grains_per_second),
               "write more than 0, and at most 100000 kg/s");
}

/// What the stages of a drive say of the feed.
void check_feed_of_stages(Scenario const& s, GivenKeys const& given) {
    bool is_fed = s.stages.empty();
    for (Stage const& stage : stages(s)) is_fed = is_fed || stage.mass_flow > 0;
    for (std::size_t i = 0; i < s.stages.size(); ++i) {
        if (!s.stages[i].mass_flow) continue;
        std::string const key = fmt::format("{}.{}.mass_flow", stages_section, i + 1);
        if (!is_open(s))
            given.fail(key, "nothing is fed, because feed.mass_flow is not given",
                       "remove it, or write a section [feed]");
        if (*s.stages[i].mass_flow > *s.feed.mass_flow * (1 + 1e-12))
            given.fail(
                key,
                fmt::format(
                    "is more than feed.mass_flow ({:.4g} kg/s), for which the place of the feed is made",
                    *s.feed.mass_flow),
                "raise feed.mass_flow, and give the other stages their own");
        if (!is_fed) given.fail(key, "nothing is fed in any stage", "write a mass_flow above 0 in one");
    }
}

/// A trough that is fed at one end and discharged at the other.
void complete_feed(Scenario& s, GivenKeys const& given) {
    if (!is_open(s)) return check_feed_of_stages(s, given);
    weigh_feed(s, given);
    check_feed_of_stages(s, given);
    s.layer.grains = grains_of_feed(s, given);
    constexpr double fastest = 1.5;  // m/s
    double const largest = largest_diameter(s), length = feed_length(s);
    if (length < 4 * largest || length > 0.5 * s.layer.length)
        given.fail(
            given.has("feed.length") ? "feed.length" : "layer.length",
            fmt::format(
                "the feed falls into the first {} of {}, which must be from 4 of the largest diameters "
                "({} each) to half of the trough",
                given.text("feed.length", length), given.text("layer.length", s.layer.length),
                given.text("grains.diameter", largest)),
            fmt::format("write feed.length = \"{}\", or lengthen the trough",
                        given.text("feed.length", 4 * largest)));
    if (s.feed.width && (*s.feed.width < 4 * largest || *s.feed.width > s.layer.width))
        given.fail(
            "feed.width",
            fmt::format("{} is not from 4 of the largest diameters ({}) to the width of the trough, {}",
                        given.text("feed.width", *s.feed.width), given.text("feed.width", 4 * largest),
                        given.text("feed.width", s.layer.width)),
            "change it, or leave it out for a stream as wide as the trough");
    given.require("feed.height", feed_height(s), floor_under_feed(s) + 3 * largest,
                  "3 of the largest diameters above the highest point of the floor under the feed, where "
                  "grains would find no room above those that lie there");
    if (feed_speed(s) > fastest)
        given.fail(
            "feed.mass_flow",
            fmt::format("it does not fit through a zone of {} by {}: the stream would have to fall into the "
                        "trough with {:.3g} m/s, faster than {} m/s",
                        given.text("feed.length", length), given.text("layer.width", feed_width(s)),
                        feed_speed(s), fastest),
            "lengthen feed.length, widen the trough, or feed less");
}

/// Every material has at least one grain.
void check_counts(Scenario const& scenario, GivenKeys const& given) {
    for (Material const& material : materials(scenario)) {
        if (material.number_fraction * scenario.layer.grains >= 1) continue;
        given.fail(given.has("layer.grains") ? "layer.grains" : height_key(given),
                   fmt::format("the layer has {} grains, and fewer than one grain of '{}'",
                               scenario.layer.grains, material.name),
                   "take a larger layer or a larger share");
    }
}

}  // namespace

void complete_layer(Scenario& scenario, GivenKeys const& given) {
    Layer& layer = scenario.layer;
    double const largest = largest_diameter(scenario);
    if (layer.length < 4 * largest || layer.width < 4 * largest) {
        std::string const least = fmt::format("4 diameters of the largest grains ({} each)",
                                              given.text("grains.diameter", largest));
        given.require("layer.length", layer.length, 4 * largest, least);
        given.require("layer.width", layer.width, 4 * largest, least);
    }
    // The floor's mesh has a triangle for every few grains on it.
    given.require_at_most("layer.length", layer.length * layer.width / (largest * largest),
                          most_grains_on_floor, "grains side by side on the floor",
                          "make the box smaller or the grains larger; is the unit of the diameter right?");
    if (scenario.trough.mesh) check_mesh(scenario, given);
    if (layer.block != Block::none) layer.grains = 1;
    if (layer.diameters) layer.height = *layer.diameters * mean_diameter(scenario);
    if (layer.height) layer.grains = grains_for(*layer.height, scenario, given);
    complete_feed(scenario, given);
    check_counts(scenario, given);
    auto const of_a_grain = static_cast<double>(shape_spheres(scenario.grains).size());
    given.require_at_most("grains.shape", layer.grains * of_a_grain, most_spheres, "spheres",
                          "take fewer grains");
}

}  // namespace vibrotrough::scenario
