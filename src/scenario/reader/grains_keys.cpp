#include "scenario/reader/key_fields.hpp"
#include "scenario/reader/value_reader.hpp"

#include <array>

namespace vibrotrough::scenario {
namespace {

using enum KeyKind;
using enum KeyNeed;

void set_shape(Grains& grains, GivenValue const& v) {
    grains.shape = v.word();
    if (grains.shape == "sphere" || grains.shape == "cube" || grains.shape == "rod") return;
    grains.shape_file = read_once(
        v.files_read().shapes, v, {v.word()},
        [](std::vector<NamedFile> files) { return read_shape(std::move(files.front())); },
        "write the header x,y,z,radius and one sphere per line");
}

/// The mass of grains per second is known when all keys are set.
void set_feed(Feed& feed, GivenValue const& v) {
    if (v.is_word()) feed.grains_per_second = grains_per_second(v.word());
    feed.mass_flow = v.is_word() ? 0 : v.number();
}

bool has_a_law(Scenario const& s) {
    return s.grains.size_law != SizeLaw::listed;
}

constexpr std::array rows_of_grains{
    Key{"grains.diameter", quantity, "m", 1e-6, 1, "1 um to 1 m", "size of the grains", required, "\"3 mm\"",
        "d, mean diameter; of a clump, the diameter of the sphere that has its volume; of the log-normal "
        "law, the median",
        field<&Scenario::grains, &Grains::diameter>.written_if(has_a_law)},
    Key{"grains.diameters", quantities, "m", 1e-6, 1, "1 um to 1 m each, up to 100", "size of the grains",
        required, "[\"2 mm\", \"3 mm\"]", "list of diameters, used with number_fractions or mass_fractions",
        KeyAccess{[](Scenario const& s) { return content_of(s.grains.diameters); },
                  [](Scenario& s, GivenValue const& v) {
                      s.grains.diameters = v.numbers();
                      s.grains.size_law = SizeLaw::listed;
                  }}},
    Key{"grains.number_fractions", numbers, "", 0, 1e9, "above 0 each", "", optional, "[0.3, 0.7]",
        "shares of the listed diameters by number, scaled so that their sum is 1",
        field<&Scenario::grains, &Grains::number_fractions>},
    Key{"grains.mass_fractions", numbers, "", 0, 1e9, "above 0 each", "", optional, "[0.3, 0.7]",
        "shares of the listed diameters by mass, scaled so that their sum is 1",
        field<&Scenario::grains, &Grains::mass_fractions>},
    Key{"grains.diameter_spread", number, "", 0, 0.5, "", "", 0.0, "0.1",
        "s, width of the size distribution, see size_law; the standard deviation of the diameters is 0.82 s "
        "of "
        "three classes, 0.58 s of a uniform and about s of a lognormal law",
        field<&Scenario::grains, &Grains::diameter_spread>.written_if(has_a_law)},
    Key{"grains.size_law", choice, "", 0, 0, one_of("three-classes", "uniform", "lognormal"), "", optional,
        "\"three-classes\"",
        "distribution by number; three-classes: 1-s, 1 and 1+s times d in equal shares; uniform: all "
        "diameters between 1-s and 1+s times d; lognormal: ln(d) is normal with standard deviation s",
        field<&Scenario::grains, &Grains::size_law>.written_if(has_a_law)},
    Key{"grains.density", quantity, "kg/m3", 1, 3e4, "1 to 30000 kg/m3", "density of the grains", required,
        "\"1400 kg/m3\"", "density of the grains' material", field<&Scenario::grains, &Grains::density>},
    Key{"grains.bulk_density", quantity, "kg/m3", 0.58, 17400, "0.58 to 17400 kg/m3", "density of the grains",
        required, "\"800 kg/m3\"",
        "density of the settled layer with its voids; the grains' density is this divided by the solid "
        "fraction of a settled layer, 0.58",
        KeyAccess{[](Scenario const& s) { return content_of(bulk_density(s.grains)); },
                  [](Scenario& s, GivenValue const& v) {
                      s.grains.density = v.number() / settled_solid_fraction;
                      s.grains.is_bulk_given = true;
                  }}
            .written_if(never)},
    Key{"grains.youngs_modulus", quantity, "Pa", 1e5, 1e12, "0.1 MPa to 1 TPa", "", optional, "\"50 MPa\"",
        "Young's modulus of grains and trough; if it is left out, the campaign gets the lowest one that is "
        "stiff enough for the depths and drives of all of its cases (solver.softness), because softer grains "
        "allow a longer time step",
        field<&Scenario::grains, &Grains::youngs_modulus>},
    Key{"grains.poisson_ratio", number, "", 0, 0.49, "", "", required, "0.35",
        "Poisson's ratio of grains and trough", field<&Scenario::grains, &Grains::poisson_ratio>},
    Key{"grains.friction", number, "", 0, 5, "", "", required, "0.5",
        "friction coefficient of grain on grain", field<&Scenario::grains, &Grains::friction>},
    Key{"grains.restitution", number, "", 0.05001, 1, "above 0.05, to 1", "", required, "0.5",
        "coefficient of restitution of grain on grain: the speed after an impact over that before",
        field<&Scenario::grains, &Grains::restitution>},
    Key{"grains.rolling_friction", number, "", 0, 5, "", "", 0.0, "0.1",
        "coefficient of the rolling friction model epsd2 at all contacts, for rotation = \"rolling\"",
        field<&Scenario::grains, &Grains::rolling_friction>},
    Key{"grains.rotation", choice, "", 0, 0, one_of("free", "rolling", "blocked"), "", optional, "\"free\"",
        "free: grains rotate freely; rolling: against rolling_friction; blocked: not at all",
        field<&Scenario::grains, &Grains::rotation>},
    Key{"grains.shape", file, "", 0, 0, file_or(".csv", "sphere", "cube", "rod"), "", optional, "\"cube\"",
        "spheres, or rigid clumps of 8 spheres (cube), 3 spheres (rod) or the spheres of a file (columns "
        "x,y,z,radius, scaled to d)",
        KeyAccess{[](Scenario const& s) { return content_of(s.grains.shape); },
                  [](Scenario& s, GivenValue const& v) { set_shape(s.grains, v); }}
            .unless_default()},

    Key{"layer.length", quantity, "m", 1e-6, 10, "at least 4 of the largest diameters", "", required,
        "\"36 mm\"",
        "length of the periodic box along the trough; with a feed, of the trough from its back wall to its "
        "edge",
        field<&Scenario::layer, &Layer::length>},
    Key{"layer.width", quantity, "m", 1e-6, 10, "at least 4 of the largest diameters", "", required,
        "\"18 mm\"", "width of the layer across the trough: of the periodic box, or between the side walls",
        field<&Scenario::layer, &Layer::width>},
    Key{"layer.height", quantity, "m", 1e-6, 10, "at least one diameter", "height of the layer", required,
        "\"12 mm\"", "height of the layer at rest",
        KeyAccess{[](Scenario const& s) { return content_of(layer_height(s)); },
                  [](Scenario& s, GivenValue const& v) { s.layer.height = v.number(); }}
            .written_if([](Scenario const& s) { return s.layer.block == Block::none && s.layer.height; })},
    Key{"layer.diameters", number, "", 1, 1000, "", "height of the layer", required, "8",
        "height of the layer at rest in mean diameters of the grains",
        KeyAccess{[](Scenario const& s) -> std::optional<Content> {
                      if (s.layer.diameters || !s.layer.height) return content_of(s.layer.diameters);
                      return Content(*s.layer.height / mean_diameter(s));
                  },
                  [](Scenario& s, GivenValue const& v) { s.layer.diameters = v.number(); }}
            .written_if(never)},
    Key{"layer.grains", integer, "", 1, 1e7, "1 to 10000000", "height of the layer", required, "600",
        "number of grains", field<&Scenario::layer, &Layer::grains>.written_if([](Scenario const& s) {
            return s.layer.block == Block::none && !s.layer.height && !is_open(s);
        })},
    Key{"layer.block", choice, "", 0, 0, one_of("point", "plate"), "height of the layer", required,
        "\"point\"",
        "replaces the layer by one rigid block with plastic contact: a sphere that cannot rotate (point) or "
        "a plate of nine spheres",
        field<&Scenario::layer, &Layer::block>.written_if(
            [](Scenario const& s) { return s.layer.block != Block::none; })},

    Key{"feed.mass_flow", quantity, "kg/s", 1e-9, 1e5, "above 0", "height of the layer", required,
        "\"0.2 t/h\"",
        "makes the trough an open one: it is empty at first, grains fall in at its back wall with this mass "
        "flow and leave it over its edge; needs trough.side_wall_friction or a mesh with upright sides. "
        "\"500 1/s\": grains of the mean mass per time",
        KeyAccess{[](Scenario const& s) { return content_of(s.feed.mass_flow); },
                  [](Scenario& s, GivenValue const& v) { set_feed(s.feed, v); }}},
    Key{"feed.length", quantity, "m", 1e-6, 10, "at least 4 of the largest diameters", "", optional,
        "\"15 mm\"",
        "length of the zone behind the back wall that the feed falls into; a tenth of the trough if it is "
        "not given",
        field<&Scenario::feed, &Feed::length>},
    Key{"feed.width", quantity, "m", 1e-6, 10, "from 4 of the largest diameters to layer.width", "", optional,
        "\"15 mm\"",
        "width of the stream, which falls into the middle of the trough; as wide as the trough if it is not "
        "given",
        field<&Scenario::feed, &Feed::width>},
    Key{"feed.height", quantity, "m", 1e-6, 10, "above the layer", "", optional, "\"40 mm\"",
        "height above the floor, or above the lowest point of the mesh, from which the feed falls; when the "
        "layer reaches it, the case ends as overfull",
        field<&Scenario::feed, &Feed::height>},

    Key{"screen.opening", quantity, "m", 0, 1, "0 to 1 m", "", optional, "\"5 mm\"",
        "makes the floor a screen with square holes of this side; what falls through is counted and taken "
        "out. "
        "0: a screen without holes, to compare with",
        field<&Scenario::screen, &Screen::opening>},
    Key{"screen.wire", quantity, "m", 1e-6, 1, "a twentieth of the opening or more", "", optional, "\"1 mm\"",
        "width of the bars between two holes; opening and wire are the pitch, of which length and width of "
        "the "
        "layer are whole multiples; with a feed only the width",
        field<&Scenario::screen, &Screen::wire>},
    Key{"screen.time", quantity, "s", 1e-3, 1e5, "0.001 to 100000 s", "", optional, "\"3 s\"",
        "how long a batch is on the screen, rounded to whole cycles; the length of screen that it stands "
        "for is "
        "in the results; not of a screen with a feed",
        field<&Scenario::screen, &Screen::time>},
};

}  // namespace

std::span<Key const> grains_keys() {
    return rows_of_grains;
}

}  // namespace vibrotrough::scenario
