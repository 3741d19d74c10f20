#include "scenario/reader/keys.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

using enum KeyKind;
using enum KeyNeed;
constexpr double radian = 57.295779513082321;  // degrees

constexpr std::array keys{
    Key{"campaign.name", name, "", 1, 100, "1 to 100 letters, digits, '.', '_' or '-'", "", required,
        "\"pvc-horizontal\"", "name of the campaign"},

    Key{"trough.inclination", quantity, "radian", -45 / radian, 45 / radian, "-45 to 45 deg", "inclination",
        required, "\"0 deg\"",
        "alpha, angle between trough and horizontal, positive if the trough rises in the conveying "
        "direction"},
    Key{"trough.tan_inclination", number, "", -1, 1, "-1 to 1", "inclination", required, "-0.05",
        "tan(alpha)"},
    Key{"trough.vibration_angle", quantity, "radian", 0, 89 / radian, "0 to 89 deg", "vibration angle",
        required, "\"30 deg\"", "beta, angle between the direction of vibration and the trough"},
    Key{"trough.tan_vibration_angle", number, "", 0, 57, "0 to 57", "vibration angle", required, "0.5",
        "tan(beta)"},
    Key{"trough.amplitude", quantity, "m", 1e-6, 1, "1 um to 1 m", "amplitude", required, "\"6 mm\"",
        "r, amplitude in the direction of vibration (half the stroke)"},
    Key{"trough.stroke", quantity, "m", 2e-6, 2, "2 um to 2 m", "amplitude", required, "\"12 mm\"",
        "2 r, distance between the ends of the vibration, twice the amplitude"},
    Key{"trough.throw_number", number, "", 1e-3, 50, "0.001 to 50", "speed of the drive", required, "2.0",
        "throw number Gamma = omega^2 r sin(beta) / (g cos(alpha))"},
    Key{"trough.machine_number", number, "", 1e-3, 1000, "0.001 to 1000", "speed of the drive", required,
        "4.0", "machine number K = omega^2 r / g"},
    Key{"trough.frequency", quantity, "Hz", 1e-2, 1e4, "0.01 Hz to 10 kHz", "speed of the drive", required,
        "\"12.9 Hz\"",
        "1/T, cycles per second; turns of the drive (\"774 rpm\", \"774 1/min\") count as cycles"},
    Key{"trough.friction", number, "", 0, 5, "0 to 5", "", required, "0.23",
        "mu, friction coefficient of grain on trough"},
    Key{"trough.restitution", number, "", 0.05001, 1, "above 0.05, to 1", "", required, "0.5",
        "e, coefficient of restitution of grain on trough"},

    Key{"trough.side_wall_friction", number, "", 0, 5, "0 to 5", "", optional, "0.3",
        "friction coefficient of grain on side wall; adds side walls that move with the trough, without "
        "which the layer is periodic across the trough"},
    Key{"trough.width", quantity, "m", 1e-3, 100, "1 mm to 100 m", "", optional, "\"300 mm\"",
        "width of the real trough, for its mass flow in t/h; with side walls it is layer.width"},
    Key{"trough.along_phase", quantity, "radian", -180 / radian, 180 / radian, "-180 to 180 deg", "", 0.0,
        "\"20 deg\"",
        "phase of the motion along the trough, x = r cos(beta) sin(omega t + along_phase); makes the drive "
        "elliptical"},
    Key{"trough.harmonics", texts, "", 0, 0, "orders 2 to 100, ratios -10 to 10", "", optional,
        "[\"25, 0.2, 0 deg\"]",
        "order, ratio and phase of further parts of the drive's acceleration; the ratio is to the "
        "fundamental (Eq. 22)"},
    Key{"trough.waveform", file, "", 0, 0, "a .csv file in the same folder", "", optional, "\"measured.csv\"",
        "one measured cycle (columns time_s,x_m,z_m) that replaces the sinusoid"},

    Key{"grains.diameter", quantity, "m", 1e-6, 1, "1 um to 1 m", "size of the grains", required, "\"3 mm\"",
        "d, mean diameter; of a clump, the diameter of the sphere that has its volume; of the log-normal "
        "law, the median"},
    Key{"grains.diameters", quantities, "m", 1e-6, 1, "1 um to 1 m each, up to 100", "size of the grains",
        required, "[\"2 mm\", \"3 mm\"]", "list of diameters, used with number_fractions or mass_fractions"},
    Key{"grains.number_fractions", numbers, "", 0, 1e9, "above 0 each", "", optional, "[0.3, 0.7]",
        "shares of the listed diameters by number, scaled so that their sum is 1"},
    Key{"grains.mass_fractions", numbers, "", 0, 1e9, "above 0 each", "", optional, "[0.3, 0.7]",
        "shares of the listed diameters by mass, scaled so that their sum is 1"},
    Key{"grains.diameter_spread", number, "", 0, 0.5, "0 to 0.5", "", 0.0, "0.1",
        "s, width of the size distribution, see size_law"},
    Key{"grains.size_law", choice, "", 0, 0, "three-classes, uniform or lognormal", "", optional,
        "\"three-classes\"",
        "distribution by number; three-classes: 1-s, 1 and 1+s times d in equal shares; uniform: all "
        "diameters between 1-s and 1+s times d; lognormal: ln(d) is normal with standard deviation s"},
    Key{"grains.density", quantity, "kg/m3", 1, 3e4, "1 to 30000 kg/m3", "density of the grains", required,
        "\"1400 kg/m3\"", "density of the grains' material"},
    Key{"grains.bulk_density", quantity, "kg/m3", 0.58, 17400, "0.58 to 17400 kg/m3", "density of the grains",
        required, "\"800 kg/m3\"",
        "density of the settled layer with its voids; the grains' density is this divided by the solid "
        "fraction of a settled layer, 0.58"},
    Key{"grains.youngs_modulus", quantity, "Pa", 1e5, 1e12, "0.1 MPa to 1 TPa", "", optional, "\"50 MPa\"",
        "Young's modulus of grains and trough; if it is left out, each case gets the lowest one that is "
        "stiff "
        "enough for its depth and drive, because softer grains allow a longer time step"},
    Key{"grains.poisson_ratio", number, "", 0, 0.49, "0 to 0.49", "", required, "0.35",
        "Poisson's ratio of grains and trough"},
    Key{"grains.friction", number, "", 0, 5, "0 to 5", "", required, "0.5",
        "friction coefficient of grain on grain"},
    Key{"grains.restitution", number, "", 0.05001, 1, "above 0.05, to 1", "", required, "0.5",
        "coefficient of restitution of grain on grain"},
    Key{"grains.rotation", choice, "", 0, 0, "free, rolling or blocked", "", optional, "\"free\"",
        "free: grains rotate freely; rolling: against rolling_friction; blocked: not at all"},
    Key{"grains.rolling_friction", number, "", 0, 5, "0 to 5", "", 0.0, "0.1",
        "coefficient of the rolling friction model epsd2 at all contacts, for rotation = \"rolling\""},
    Key{"grains.shape", file, "", 0, 0, "sphere, cube, rod or a .csv file in the same folder", "", optional,
        "\"cube\"",
        "spheres, or rigid clumps of 8 spheres (cube), 3 spheres (rod) or the spheres of a file (columns "
        "x,y,z,radius, scaled to d)"},

    Key{"layer.length", quantity, "m", 1e-6, 10, "at least 4 of the largest diameters", "", required,
        "\"36 mm\"", "length of the periodic box along the trough"},
    Key{"layer.width", quantity, "m", 1e-6, 10, "at least 4 of the largest diameters", "", required,
        "\"18 mm\"", "width of the layer across the trough: of the periodic box, or between the side walls"},
    Key{"layer.height", quantity, "m", 1e-6, 10, "at least one diameter", "height of the layer", required,
        "\"12 mm\"", "height of the layer at rest"},
    Key{"layer.grains", integer, "", 1, 1e7, "1 to 10000000", "height of the layer", required, "600",
        "number of grains"},

    Key{"layer.block", choice, "", 0, 0, "point or plate", "height of the layer", required, "\"point\"",
        "replaces the layer by one rigid block with plastic contact: a sphere that cannot rotate (point) or "
        "a plate of nine spheres"},

    Key{"measure.packings", integer, "", 1, 1000, "1 to 1000", "", 3.0, "3",
        "least number of independent packings per case; more are added until the case's interval is narrow "
        "enough"},
    Key{"measure.max_packings", integer, "", 1, 1000, "1 to 1000", "", 24.0, "24",
        "largest number of packings per case; at least measure.packings"},
    Key{"measure.max_core_time", quantity, "s", 1, 1e12, "at least 1 s", "", optional, "\"2 hours\"",
        "largest core time that one case may take: when more would be needed, it ends as not-precise"},
    Key{"measure.confidence", number, "", 0.5, 0.9999, "0.5 to 0.9999", "", 0.95, "0.95",
        "confidence level of every interval"},
    Key{"measure.half_width", number, "", 1e-5, 1, "0.00001 to 1", "", 0.05, "0.05",
        "half-width of the case's velocity efficiency that is wanted, for statistics and numerics together"},
    Key{"measure.max_cycles", integer, "", 20, 1e6, "20 to 1000000", "", 200.0, "200",
        "largest number of cycles of a packing"},
    Key{"measure.rolling", truth, "", 0, 1, "true or false", "", 0.0, "true",
        "also measure the contacts at the floor within the cycle: how the lowest grains spin and slide, with "
        "which forces and torques; for layers of spheres without side walls"},

    Key{"output.frames_per_cycle", integer, "", 0, 1000, "0 to 1000", "", 0.0, "0",
        "frames per cycle that the first packing writes for ParaView; 0 writes none"},
    Key{"output.frame_packings", packings, "", 1, 1000, "numbers from 1 to 1000, or \"all\"", "", optional,
        "[1, 2]", "packings that write the frames, by their numbers; without it, the first one"},
    Key{"output.contacts", truth, "", 0, 1, "true or false", "", 0.0, "true",
        "also write the contacts between grains and with the trough into the frames, with their forces; for "
        "layers of spheres"},
    Key{"output.checkpoint_cycles", integer, "", 0, 1e6, "0 to 1000000", "", 50.0, "50",
        "cycles between two checkpoints, from which an interrupted run continues; 0 writes none"},

    Key{"solver.rayleigh_fraction", number, "", 0.01, 0.5, "0.01 to 0.5", "", 0.2, "0.2",
        "largest time step, as a fraction of the Rayleigh time of the smallest grain"},
    Key{"solver.block_stiffness", number, "", 30, 10000, "30 to 10000", "", 300.0, "300",
        "duration of a cycle divided by the duration of a block's contact"},

    Key{"engine.contact", choice, "", 0, 0, "hertz or hooke", "", optional, "\"hooke\"",
        "normal force of the contacts; hertz: proportional to overlap^(3/2), as elasticity theory says; "
        "hooke: a linear spring as stiff as a Hertz contact in the fastest expected impact"},
    Key{"engine.cohesion", quantity, "J/m3", 0, 1e9, "0 to 1e9 J/m3", "", 0.0, "\"50 kJ/m3\"",
        "energy density of the cohesion model sjkr: grains and trough attract each other with this pressure "
        "times the area of their contact"},
    Key{"engine.extra", file, "", 0, 0, "none or a .liggghts file in the same folder", "", optional,
        "\"rotor.liggghts\"",
        "commands of LIGGGHTS that the decks run as well; they can do anything, so that 'run' shows them and "
        "refuses unless --allow-extra is given"},
    Key{"engine.templates", texts, "", 0, 0, "1 to 30 names of .mustache files in the same folder", "",
        optional, "[\"contact.mustache\"]",
        "templates of the decks that replace those of input_templates; like extra they need --allow-extra. "
        "'run --templates DIR' takes them from a folder instead"},
};

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0]++;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            std::size_t const substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
        }
    }
    return row.back();
}

}  // namespace

std::span<Key const> all_keys() {
    return keys;
}

Key const* find_key(std::string_view path) {
    auto const found = std::ranges::find(keys, path, &Key::path);
    return found == keys.end() ? nullptr : &*found;
}

bool is_optional(Key const& key) {
    return key.if_missing != IfMissing(required);
}

std::vector<std::string_view> choices(Key const& key) {
    std::vector<std::string_view> words;
    for (std::string_view rest = key.range; !rest.empty();) {
        std::size_t const end = std::min({rest.find(", "), rest.find(" or "), rest.size()});
        words.push_back(rest.substr(0, end));
        rest.remove_prefix(std::min(rest.size(), end + (rest.substr(end).starts_with(", ") ? 2 : 4)));
    }
    return words;
}

std::string key_reference() {
    std::string text = "| key | example | range | default | meaning |\n|---|---|---|---|---|\n";
    std::vector<Key> all(keys.begin(), keys.end());
    all.insert(all.end(), run_keys().begin(), run_keys().end());
    for (Key const& key : all) {
        std::string needed = is_optional(key) ? "none" : "required";
        if (auto const* value = std::get_if<double>(&key.if_missing)) needed = fmt::format("{:g}", *value);
        if (key.kind == KeyKind::truth) needed = needed == "0" ? "false" : "true";
        if (key.kind == KeyKind::choice || key.path == "grains.shape" || key.path == "engine.extra")
            needed = choices(key).front();
        if (!key.group.empty()) needed = "exactly one of these";
        text += fmt::format("| `{}` | `{}` | {} | {} | {} |\n", key.path, key.example, key.range, needed,
                            key.meaning);
    }
    return text;
}

std::string_view nearest_key(std::string_view path) {
    if (path.size() > 64) return {};
    auto const distance = [&](Key const& key) { return edit_distance(path, key.path); };
    auto const nearest = std::ranges::min_element(keys, {}, distance);
    return distance(*nearest) <= 4 ? nearest->path : std::string_view{};
}

}  // namespace vibrotrough::scenario
