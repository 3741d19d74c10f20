#include "scenario/model/scenario.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::scenario {
namespace {

// fmt's "{}" prints the shortest text that reads back as the same double.

std::string angle_toml(char const* name, double angle, std::optional<double> const& tangent) {
    if (tangent) return fmt::format("tan_{} = {}\n", name, *tangent);
    return fmt::format("{} = \"{} radian\"\n", name, angle);
}

std::string frequency_toml(Trough const& t) {
    if (t.given.throw_number) return fmt::format("throw_number = {}\n", *t.given.throw_number);
    if (t.given.machine_number) return fmt::format("machine_number = {}\n", *t.given.machine_number);
    return fmt::format("frequency = \"{} Hz\"\n", t.frequency);
}

std::string trough_toml(Trough const& t) {
    std::string text =
        fmt::format("[trough]\n{}{}amplitude = \"{} m\"\n{}friction = {}\nrestitution = {}\n",
                    angle_toml("inclination", t.inclination, t.given.tan_inclination),
                    angle_toml("vibration_angle", t.vibration_angle, t.given.tan_vibration_angle),
                    t.amplitude, frequency_toml(t), t.friction, t.restitution);
    if (t.side_wall_friction) text += fmt::format("side_wall_friction = {}\n", *t.side_wall_friction);
    if (t.width) text += fmt::format("width = \"{} m\"\n", *t.width);
    if (t.along_phase != 0) text += fmt::format("along_phase = \"{} radian\"\n", t.along_phase);
    if (!t.harmonics.empty()) {
        std::vector<std::string> list;
        for (DriveHarmonic const& harmonic : t.harmonics) {
            list.push_back(
                fmt::format("\"{}, {}, {} radian\"", harmonic.order, harmonic.ratio, harmonic.phase));
        }
        text += fmt::format("harmonics = [{}]\n", fmt::join(list, ", "));
    }
    if (t.waveform) text += fmt::format("waveform = \"{}\"\n", t.waveform->file.name);
    return text + "\n";
}

std::string sizes_toml(Grains const& g) {
    if (g.size_law == SizeLaw::listed) {
        std::vector<std::string> diameters;
        for (double const diameter : g.diameters) diameters.push_back(fmt::format("\"{} m\"", diameter));
        bool const by_number = !g.number_fractions.empty();
        return fmt::format("diameters = [{}]\n{} = [{}]\n", fmt::join(diameters, ", "),
                           by_number ? "number_fractions" : "mass_fractions",
                           fmt::join(by_number ? g.number_fractions : g.mass_fractions, ", "));
    }
    std::string const text =
        fmt::format("diameter = \"{} m\"\ndiameter_spread = {}\n", g.diameter, g.diameter_spread);
    return text + fmt::format("size_law = \"{}\"\n", name_of(g.size_law));
}

std::string grains_toml(Grains const& g) {
    std::string const modulus =
        g.youngs_modulus ? fmt::format("youngs_modulus = \"{} Pa\"\n", *g.youngs_modulus) : "";
    std::string text =
        "[grains]\n" + sizes_toml(g) +
        fmt::format(
            "density = \"{} kg/m3\"\n{}poisson_ratio = {}\n"
            "friction = {}\nrestitution = {}\nrolling_friction = {}\n",
            g.density, modulus, g.poisson_ratio, g.friction, g.restitution, g.rolling_friction);
    text += fmt::format("rotation = \"{}\"\n", name_of(g.rotation));
    if (is_clump(g)) text += fmt::format("shape = \"{}\"\n", g.shape);
    return text + "\n";
}

std::string layer_toml(Layer const& l) {
    std::string const text = fmt::format("[layer]\nlength = \"{} m\"\nwidth = \"{} m\"\n", l.length, l.width);
    if (l.block != Block::none) return text + fmt::format("block = \"{}\"\n\n", name_of(l.block));
    if (l.height) return text + fmt::format("height = \"{} m\"\n\n", *l.height);
    return text + fmt::format("grains = {}\n\n", l.grains);
}

}  // namespace

std::string_view name_of(Block block) {
    switch (block) {
        case Block::none:
            return "none";
        case Block::point:
            return "point";
        case Block::plate:
            return "plate";
    }
    throw std::invalid_argument("no such block");
}

double angular_frequency(Trough const& trough) {
    return 2 * std::numbers::pi * trough.frequency;
}

double machine_number(Trough const& trough) {
    if (trough.given.machine_number) return *trough.given.machine_number;
    double const omega = angular_frequency(trough);
    return omega * omega * trough.amplitude / gravity;
}

double throw_number(Trough const& trough) {
    if (trough.given.throw_number) return *trough.given.throw_number;
    return machine_number(trough) * std::sin(trough.vibration_angle) / std::cos(trough.inclination);
}

double in_degrees(double radian) {
    constexpr double degree = std::numbers::pi / 180;
    for (int digits = 1; digits < 17; ++digits) {
        double const shorter = std::stod(fmt::format("{:.{}g}", radian / degree, digits));
        if (std::abs(shorter * degree - radian) <= std::abs(radian) * std::numeric_limits<double>::epsilon())
            return shorter;
    }
    return radian / degree;
}

double velocity_scale(Trough const& trough) {
    return angular_frequency(trough) * trough.amplitude * std::cos(trough.vibration_angle);
}

double bulk_density(Grains const& grains) {
    return settled_solid_fraction * grains.density;
}

double mass_per_area(Scenario const& s) {
    return s.layer.grains * s.grains.density * mean_grain_volume(s.grains) / (s.layer.length * s.layer.width);
}

std::optional<double> trough_width(Scenario const& s) {
    if (s.trough.width) return s.trough.width;
    if (s.trough.side_wall_friction) return s.layer.width;
    return {};
}

double layer_height(Scenario const& s) {
    if (s.layer.height) return *s.layer.height;
    return s.layer.grains * mean_grain_volume(s.grains) /
           (settled_solid_fraction * s.layer.length * s.layer.width);
}

bool writes_frames(OutputPlan const& output, int packing) {
    if (output.frames_per_cycle == 0) return false;
    return output.frame_packings.empty() || std::ranges::binary_search(output.frame_packings, packing);
}

int packings_with_frames(OutputPlan const& output, int packings) {
    int count = 0;
    for (int packing = 1; packing <= packings; ++packing) count += writes_frames(output, packing) ? 1 : 0;
    return count;
}

std::string frame_toml(OutputPlan const& output) {
    if (output.frames_per_cycle == 0) return {};
    std::string text;
    if (output.frame_packings.empty())
        text = "frame_packings = \"all\"\n";
    else if (output.frame_packings != std::vector<int>{1})
        text = fmt::format("frame_packings = [{}]\n", fmt::join(output.frame_packings, ", "));
    if (output.contacts) text += "contacts = true\n";
    return text;
}

std::string to_toml(Scenario const& s) {
    return fmt::format("[campaign]\nname = \"{}\"\n\n", s.campaign) + trough_toml(s.trough) +
           grains_toml(s.grains) + layer_toml(s.layer) +
           fmt::format(
               "[measure]\npackings = {}\nconfidence = {}\nhalf_width = {}\nmax_cycles = {}\n"
               "max_packings = {}\n{}{}\n"
               "[output]\nframes_per_cycle = {}\ncheckpoint_cycles = {}\n{}\n"
               "[solver]\nrayleigh_fraction = {}\nblock_stiffness = {}\n",
               s.measure.packings, s.measure.confidence, s.measure.half_width, s.measure.max_cycles,
               s.measure.max_packings,
               s.measure.max_core_time ? fmt::format("max_core_time = \"{} s\"\n", *s.measure.max_core_time)
                                       : "",
               s.measure.rolling ? "rolling = true\n" : "", s.output.frames_per_cycle,
               s.output.checkpoint_cycles, frame_toml(s.output), s.solver.rayleigh_fraction,
               s.solver.block_stiffness) +
           (engine_toml(s.engine).empty() ? "" : "\n" + engine_toml(s.engine));
}

std::vector<NamedFile> named_files(Scenario const& scenario) {
    std::vector<NamedFile> files;
    if (scenario.grains.shape_file) files.push_back(scenario.grains.shape_file->file);
    if (scenario.trough.waveform) files.push_back(scenario.trough.waveform->file);
    if (scenario.engine.extra) files.push_back(scenario.engine.extra->file);
    if (scenario.engine.templates) {
        auto const& templates = scenario.engine.templates->files;
        files.insert(files.end(), templates.begin(), templates.end());
    }
    return files;
}

}  // namespace vibrotrough::scenario
