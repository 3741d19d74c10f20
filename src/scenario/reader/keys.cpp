#include "scenario/reader/keys.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

using enum KeyKind;
constexpr double radian = 57.295779513082321;  // degrees
constexpr double none = std::numeric_limits<double>::quiet_NaN();

constexpr std::array keys{
    Key{"campaign.name",
        name,
        "",
        1,
        100,
        "1 to 100 letters, digits, '.', '_' or '-'",
        "",
        {},
        "\"pvc-horizontal\"",
        "name of the campaign"},

    Key{"trough.inclination",
        quantity,
        "radian",
        -45 / radian,
        45 / radian,
        "-45 to 45 deg",
        "inclination",
        {},
        "\"0 deg\"",
        "alpha, trough against horizontal, uphill positive in the conveying direction"},
    Key{"trough.tan_inclination", number, "", -1, 1, "-1 to 1", "inclination", {}, "-0.05", "tan(alpha)"},
    Key{"trough.vibration_angle",
        quantity,
        "radian",
        0,
        89 / radian,
        "0 to 89 deg",
        "vibration angle",
        {},
        "\"30 deg\"",
        "beta, between the direction of vibration and the trough"},
    Key{"trough.tan_vibration_angle",
        number,
        "",
        0,
        57,
        "0 to 57",
        "vibration angle",
        {},
        "0.5",
        "tan(beta)"},
    Key{"trough.amplitude",
        quantity,
        "m",
        1e-6,
        1,
        "1 um to 1 m",
        "",
        {},
        "\"6 mm\"",
        "r, in the direction of vibration: half the stroke"},
    Key{"trough.throw_number",
        number,
        "",
        1e-3,
        50,
        "0.001 to 50",
        "speed of the drive",
        {},
        "2.0",
        "Gamma = omega^2 r sin(beta) / (g cos(alpha))"},
    Key{"trough.machine_number",
        number,
        "",
        1e-3,
        1000,
        "0.001 to 1000",
        "speed of the drive",
        {},
        "4.0",
        "K = omega^2 r / g"},
    Key{"trough.frequency",
        quantity,
        "Hz",
        1e-2,
        1e4,
        "0.01 Hz to 10 kHz",
        "speed of the drive",
        {},
        "\"12.9 Hz\"",
        "1/T, cycles per second"},
    Key{"trough.friction", number, "", 0, 5, "0 to 5", "", {}, "0.23", "mu, grain on trough"},
    Key{"trough.restitution",
        number,
        "",
        0.05001,
        1,
        "above 0.05, to 1",
        "",
        {},
        "0.5",
        "e, grain on trough"},

    Key{"trough.side_wall_friction", number, "", 0, 5, "0 to 5", "", none, "0.3",
        "side walls that move with the trough, and their friction; without it periodic across"},
    Key{"trough.along_phase", quantity, "radian", -180 / radian, 180 / radian, "-180 to 180 deg", "", 0.0,
        "\"20 deg\"", "x = r cos(beta) sin(omega t + along_phase): an elliptical drive"},
    Key{"trough.harmonics", harmonics, "", 0, 0, "orders 2 to 100, ratios -10 to 10", "", none,
        "[\"25, 0.2, 0 deg\"]", "order, ratio and phase of further parts of the acceleration (Eq. 22)"},
    Key{"trough.waveform", file, "", 0, 0, "a .csv beside this file", "", none, "\"measured.csv\"",
        "one measured cycle (time_s,x_m,z_m) instead of the sinusoid"},

    Key{"grains.diameter",
        quantity,
        "m",
        1e-6,
        1,
        "1 um to 1 m",
        "size of the grains",
        {},
        "\"3 mm\"",
        "d: mean; of a clump, of the sphere with its volume; of the log-normal law, the median"},
    Key{"grains.diameters",
        quantities,
        "m",
        1e-6,
        1,
        "1 um to 1 m each, up to 100",
        "size of the grains",
        {},
        "[\"2 mm\", \"3 mm\"]",
        "a list of diameters, with number_fractions or mass_fractions"},
    Key{"grains.number_fractions", numbers, "", 0, 1e9, "above 0 each", "", none, "[0.3, 0.7]",
        "of the listed diameters; their sum is taken as 1"},
    Key{"grains.mass_fractions", numbers, "", 0, 1e9, "above 0 each", "", none, "[0.3, 0.7]",
        "of the listed diameters; their sum is taken as 1"},
    Key{"grains.diameter_spread", number, "", 0, 0.5, "0 to 0.5", "", 0.0, "0.1", "s, see size_law"},
    Key{"grains.size_law", choice, "", 0, 0, "three-classes, uniform or lognormal", "", none,
        "\"three-classes\"",
        "by number: 1-s, 1 and 1+s times d in equal shares; all between 1-s and 1+s; ln(d) normal with "
        "standard "
        "deviation s"},
    Key{"grains.density",
        quantity,
        "kg/m3",
        1,
        3e4,
        "1 to 30000 kg/m3",
        "",
        {},
        "\"1400 kg/m3\"",
        "of the grain's material"},
    Key{"grains.youngs_modulus",
        quantity,
        "Pa",
        1e5,
        1e12,
        "0.1 MPa to 1 TPa",
        "",
        {},
        "\"5 MPa\"",
        "of grain and trough; softer than nature on purpose, to allow a longer time step"},
    Key{"grains.poisson_ratio", number, "", 0, 0.49, "0 to 0.49", "", {}, "0.35", "of grain and trough"},
    Key{"grains.friction", number, "", 0, 5, "0 to 5", "", {}, "0.5", "grain on grain"},
    Key{"grains.restitution", number, "", 0.05001, 1, "above 0.05, to 1", "", {}, "0.5", "grain on grain"},
    Key{"grains.rotation", choice, "", 0, 0, "free, rolling or blocked", "", none, "\"free\"",
        "rolling: rolling_friction resists; blocked: grains do not rotate"},
    Key{"grains.rolling_friction", number, "", 0, 5, "0 to 5", "", 0.0, "0.1",
        "coefficient of the epsd2 model, all contacts, for rotation = \"rolling\""},
    Key{"grains.shape", file, "", 0, 0, "sphere, cube, rod or a .csv beside this file", "", none, "\"cube\"",
        "rigid clumps of 8 and 3 spheres, or those of a file (x,y,z,radius, scaled to d)"},

    Key{"layer.length",
        quantity,
        "m",
        1e-6,
        10,
        "at least 4 of the largest diameters",
        "",
        {},
        "\"36 mm\"",
        "of the periodic box along the trough"},
    Key{"layer.width",
        quantity,
        "m",
        1e-6,
        10,
        "at least 4 of the largest diameters",
        "",
        {},
        "\"18 mm\"",
        "of the periodic box across the trough"},
    Key{"layer.height",
        quantity,
        "m",
        1e-6,
        10,
        "at least one diameter",
        "height of the layer",
        {},
        "\"12 mm\"",
        "of the layer at rest"},
    Key{"layer.grains",
        integer,
        "",
        1,
        1e7,
        "1 to 10000000",
        "height of the layer",
        {},
        "600",
        "number of grains"},

    Key{"layer.block",
        choice,
        "",
        0,
        0,
        "point or plate",
        "height of the layer",
        {},
        "\"point\"",
        "no layer: one rigid block with plastic contact, a sphere that cannot rotate or a plate of nine"},

    Key{"measure.packings", integer, "", 1, 1000, "1 to 1000", "", 3, "3",
        "independent packings per case; the interval comes from all of them"},
    Key{"measure.confidence", number, "", 0.5, 0.9999, "0.5 to 0.9999", "", 0.95, "0.95",
        "of every interval"},
    Key{"measure.half_width", number, "", 1e-5, 1, "0.00001 to 1", "", 0.02, "0.02",
        "of velocity efficiency; a packing runs until its mean is this well known"},
    Key{"measure.max_cycles", integer, "", 20, 1e6, "20 to 1000000", "", 200, "200", "per packing"},

    Key{"output.frames_per_cycle", integer, "", 0, 1000, "0 to 1000", "", 0, "0",
        "frames of the first packing for ParaView; 0 writes none"},
    Key{"output.checkpoint_cycles", integer, "", 0, 1e6, "0 to 1000000", "", 50, "50",
        "cycles between checkpoints, from which a killed run goes on; 0 writes none"},

    Key{"solver.rayleigh_fraction", number, "", 0.01, 0.5, "0.01 to 0.5", "", 0.2, "0.2",
        "largest time step, in Rayleigh times of the smallest grain"},
    Key{"solver.block_stiffness", number, "", 30, 10000, "30 to 10000", "", 300, "300",
        "a block's contact lasts the cycle divided by this"},
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
    return key.fallback.has_value();
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
        std::string needed = "required";
        if (key.fallback) needed = std::isnan(*key.fallback) ? "none" : fmt::format("{:g}", *key.fallback);
        if (key.kind == KeyKind::choice || key.path == "grains.shape") needed = choices(key).front();
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
