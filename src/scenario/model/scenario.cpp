#include "scenario/model/scenario.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

namespace vibrotrough::scenario {

std::string_view name_of(Block block) {
    constexpr std::array<std::string_view, 3> names{"none", "point", "plate"};
    return names.at(static_cast<std::size_t>(block));
}

double angular_frequency(Trough const& trough) {
    return 2 * std::numbers::pi * trough.frequency;
}

double machine_number(Trough const& trough) {
    if (trough.given.machine_number) return *trough.given.machine_number;
    double const omega = angular_frequency(trough);
    return omega * omega * trough.amplitude / trough.gravity;
}

double throw_number(Trough const& trough) {
    if (trough.given.throw_number) return *trough.given.throw_number;
    return machine_number(trough) * std::sin(trough.vibration_angle) / std::cos(trough.inclination);
}

double frequency_of(Trough const& trough) {
    if (!trough.given.throw_number && !trough.given.machine_number) return trough.frequency;
    double const machine_number =
        trough.given.throw_number
            ? *trough.given.throw_number * std::cos(trough.inclination) / std::sin(trough.vibration_angle)
            : *trough.given.machine_number;
    return std::sqrt(machine_number * trough.gravity / trough.amplitude) / (2 * std::numbers::pi);
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

bool is_vertical(Trough const& trough) {
    return std::cos(trough.vibration_angle) < 1e-9;
}

double length_scale(Trough const& trough) {
    return is_vertical(trough) ? trough.amplitude : trough.amplitude * std::cos(trough.vibration_angle);
}

double velocity_scale(Trough const& trough) {
    return angular_frequency(trough) * length_scale(trough);
}

double bulk_density(Grains const& grains) {
    return settled_solid_fraction * grains.density;
}

double mass_per_area(Scenario const& s) {
    return s.layer.grains * mean_density(s) * mean_grain_volume(s) / (s.layer.length * s.layer.width);
}

std::optional<double> trough_width(Scenario const& s) {
    if (s.trough.width) return s.trough.width;
    bool const has_walls = s.trough.side_wall_friction || (s.trough.mesh && s.trough.mesh->has_upright_sides);
    if (has_walls) return s.layer.width;
    return {};
}

double mean_layer_depth(Scenario const& s) {
    return s.layer.grains * mean_grain_volume(s) / (settled_solid_fraction * s.layer.length * s.layer.width);
}

double layer_height(Scenario const& s) {
    if (s.layer.height) return *s.layer.height;
    if (!s.trough.mesh) return mean_layer_depth(s);
    double const unit = metres_in(s.trough.mesh_unit);
    TroughMesh const& mesh = *s.trough.mesh;
    // It flows through an open trough, whose lowest end it does not fill as a pond.
    if (is_open(s)) return unit * mesh.level_across(mean_layer_depth(s) / unit, 0, mesh.extent[0]).depth;
    double const volume = s.layer.grains * mean_grain_volume(s) / settled_solid_fraction;
    return unit * mesh.level_of(volume / (unit * unit * unit));
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

std::vector<std::string> remarks(Scenario const& scenario) {
    std::vector<std::string> all;
    if (scenario.trough.mesh)
        for (std::string const& repair : scenario.trough.mesh->repairs)
            all.push_back(fmt::format("{}: {}", scenario.trough.mesh->names(), repair));
    if (!scenario.trough.given.replaced.empty()) all.push_back(scenario.trough.given.replaced);
    if (scenario.trough.waveform)
        all.insert(all.end(), scenario.trough.waveform->remarks.begin(),
                   scenario.trough.waveform->remarks.end());
    return all;
}

std::vector<NamedFile> named_files(Scenario const& scenario) {
    std::vector<NamedFile> files;
    if (scenario.grains.shape_file) files.push_back(scenario.grains.shape_file->file);
    if (scenario.trough.mesh)
        for (NamedFile const& file : scenario.trough.mesh->files) files.push_back(file);
    if (scenario.trough.waveform) files.push_back(scenario.trough.waveform->file);
    for (GivenStage const& stage : scenario.stages)
        if (stage.waveform &&
            std::ranges::find(files, stage.waveform->file.name, &NamedFile::name) == files.end())
            files.push_back(stage.waveform->file);
    if (scenario.engine.templates) {
        auto const& templates = scenario.engine.templates->files;
        files.insert(files.end(), templates.begin(), templates.end());
    }
    return files;
}

}  // namespace vibrotrough::scenario
