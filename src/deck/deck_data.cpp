#include "deck/deck_data.hpp"

#include "deck/atom_types.hpp"
#include "deck/drive_formula.hpp"
#include "deck/estimates.hpp"
#include "deck/stage_data.hpp"
#include "deck/trough_mesh.hpp"
#include "prepare/contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <boost/math/special_functions/prime.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::deck {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

std::string text(double number) {
    return fmt::format("{}", number);
}

std::string rounded(double number) {
    return fmt::format("{:.6g}", number);
}

bool is_body(scenario::Scenario const& s) {
    return is_clump(s.grains) || s.layer.block == scenario::Block::plate;
}

scenario::Material const& material_of(prepare::PreparedCase const& n, prepare::ClassCount const& size) {
    return n.materials[static_cast<std::size_t>(size.material)];
}

/// Whether a grain or the region for pouring is near the engine's least volumes of 1e-12 and 1e-10 m^3, which
/// are mistakes of units elsewhere. The deck then lowers both.
bool is_small(prepare::PreparedCase const& n) {
    scenario::Layer const& layer = n.scenario.layer;
    return std::pow(n.classes.back().diameter, 3) < 1e-11 ||
           layer.length * layer.width * (n.fill_top - n.fill_bottom) < 1e-9;
}

std::string template_of(prepare::PreparedCase const& n, prepare::ClassCount const& size, int index) {
    scenario::Scenario const& s = n.scenario;
    std::string const start =
        fmt::format("{} {} atom_type {} density constant {}{}", is_body(s) ? "multisphere" : "sphere",
                    seed_number(4000 + index), atom_type_of(n, size.material),
                    material_of(n, size).grains.density, is_small(n) ? " volume_limit 1e-30" : "");
    if (!n.clump) return fmt::format("{} radius constant {}", start, size.diameter / 2);
    std::vector<std::string> spheres, inertia;
    for (scenario::Sphere const& sphere : n.clump->spheres)
        spheres.push_back(fmt::format("{} {} {} {}", sphere.x, sphere.y, sphere.z, sphere.radius));
    for (double const moment : n.clump->inertia) inertia.push_back(text(moment * s.grains.density));
    bool const turns = s.grains.rotation != scenario::Rotation::blocked;
    return fmt::format("{} nspheres {} ntry 100000 spheres {} type 1 mass {} inertia_tensor {} use_density{}",
                       start, spheres.size(), fmt::join(spheres, " "), n.clump->volume * s.grains.density,
                       fmt::join(inertia, " "), turns ? "" : " tflag off off off");
}

std::vector<core::TemplateData> describe_classes(prepare::PreparedCase const& n, int packing) {
    std::vector<core::TemplateData> list;
    int index = 0;
    int so_far = 0;  // insert/pack fills the region up to a number, which includes the grains already there
    // Each packing has its own seeds, one prime per size class and at least three.
    int const stride = std::max(3, static_cast<int>(n.classes.size()));
    for (prepare::ClassCount const& size : n.classes) {
        core::TemplateData entry;
        so_far += is_open(n.scenario) ? 1 : size.count;  // an open trough begins with one of each
        entry.set("index", std::to_string(index + 1));
        entry.set("diameter", text(size.diameter));
        entry.set("count", std::to_string(size.count));
        entry.set("of_material",
                  n.materials.size() == 1 ? std::string() : fmt::format(" ({})", material_of(n, size).name));
        entry.set("count_so_far", std::to_string(so_far));
        entry.set("mass_share",
                  rounded(size.share * material_of(n, size).grains.density * std::pow(size.diameter, 3)));
        entry.set("template", template_of(n, size, index));
        entry.set("insertion_seed", std::to_string(seed_number(stride * (packing - 1) + index)));
        entry.set("distribution_seed", std::to_string(seed_number(4010 + 100 + index)));
        list.push_back(std::move(entry));
        ++index;
    }
    return list;
}

std::string grain_words(scenario::Scenario const& s) {
    if (s.layer.block == scenario::Block::point) return "block, a sphere that does not rotate,";
    if (s.layer.block == scenario::Block::plate) return "block, a plate of nine spheres,";
    return is_clump(s.grains) ? fmt::format("clumps of shape {}", s.grains.shape) : "spheres";
}

void describe_inputs(core::TemplateData& data, scenario::Scenario const& s) {
    data.set("inclination_deg", rounded(s.trough.inclination * degrees));
    data.set("trough_friction", text(s.trough.friction));
    data.set("trough_restitution", text(s.trough.restitution));
    data.set("walls", s.trough.side_wall_friction.has_value());
    data.set("side_wall_friction", text(s.trough.side_wall_friction.value_or(0)));
    data.set("grains", std::to_string(s.layer.grains));
    data.set("grain_words", grain_words(s));
    data.set("density", text(s.grains.density));
    data.set("youngs_modulus", text(s.grains.youngs_modulus.value()));
    data.set("poisson_ratio", text(s.grains.poisson_ratio));
    data.set("grain_friction", text(s.grains.friction));
    data.set("grain_restitution", text(s.grains.restitution));
    data.set("rolling_friction", text(s.grains.rolling_friction));
    data.set("rotation", std::string(name_of(s.grains.rotation)));
    data.set("length", text(s.layer.length));
    data.set("width", text(s.layer.width));
    describe_gravity(data, s);
}

std::string integrator(scenario::Scenario const& s) {
    if (is_body(s)) return "multisphere allow_group_and_set yes";
    return s.grains.rotation == scenario::Rotation::blocked ? "nve" : "nve/sphere";
}

/// The meshes that move with the trough.
std::vector<std::string> moving_meshes(prepare::PreparedCase const& n) {
    std::vector<std::string> meshes{"trough"};
    for (std::size_t i = 0; i < n.domain.parts.size(); ++i) meshes.push_back(part_mesh(i));
    if (n.scenario.trough.side_wall_friction) meshes.insert(meshes.end(), {"left", "right"});
    if (n.domain.open) meshes.emplace_back("back");
    if (is_fed_screen(n.scenario)) meshes.emplace_back("end");
    return meshes;
}

/// A record without stages is moved by the engine's own sum of sines.
void describe_record(core::TemplateData& data, prepare::PreparedCase const& n) {
    bool const is_record = n.scenario.trough.waveform && n.stages.empty();
    std::vector<core::TemplateData> movers;
    for (std::string const& mesh : moving_meshes(n)) {
        for (char const* axis : {"1 0 0", "0 0 1"}) {
            auto const& terms = *axis == '1' ? n.motion.along : n.motion.normal;
            if (!is_record || terms.empty()) continue;
            SineMover const sum = sine_mover(terms, n.time.time_step, n.time.steps_per_cycle);
            core::TemplateData mover;
            mover.set("order", std::to_string(terms.size()));
            mover.set("amplitudes", sum.amplitudes);
            mover.set("phases", sum.phases);
            mover.set("periods", sum.periods);
            mover.set("fix", fmt::format("drive_{}_{}", mesh, *axis == '1' ? 'x' : 'z'));
            mover.set("mesh", mesh);
            mover.set("axis", axis);
            movers.push_back(std::move(mover));
        }
    }
    data.set("also_record", is_record);
    data.set("also_movers", std::move(movers));
}

void describe_drive(core::TemplateData& data, prepare::PreparedCase const& n) {
    scenario::Scenario const& s = n.scenario;
    prepare::TimeGrid const& time = n.time;
    data.set("vibration_angle_deg", rounded(s.trough.vibration_angle * degrees));
    data.set("amplitude", text(s.trough.amplitude));
    data.set("frequency", text(s.trough.frequency));
    data.set("throw_number", rounded(n.throw_number));
    data.set("machine_number", rounded(n.machine_number));
    std::string remark;
    if (s.trough.waveform)
        remark = fmt::format(",\n#             waveform of {}", s.trough.waveform->file.name);
    if (s.trough.along_phase != 0)
        remark += fmt::format(",\n#             x ahead of z by {:.6g} deg", s.trough.along_phase * degrees);
    for (scenario::DriveHarmonic const& harmonic : s.trough.harmonics) {
        remark += fmt::format(
            ",\n#             harmonic of order {} with {} times the acceleration, phase {:.6g} deg",
            harmonic.order, harmonic.ratio, harmonic.phase * degrees);
    }
    data.set("drive_remark", remark);
    describe_stages(data, n);
    describe_record(data, n);
    // With stages the velocity is set before each cycle.
    bool const has_formula = n.stages.empty() && !s.trough.waveform;
    scenario::DriveMotion const motion = has_formula ? n.motion : scenario::DriveMotion{};
    std::vector<core::TemplateData> lines;
    for (auto const& [axis, terms] :
         {std::pair{std::string("x"), &motion.along}, std::pair{std::string("z"), &motion.normal}}) {
        DriveFormula const formula = drive_formula(*terms, axis);
        for (Formula const& term : formula.terms) {
            core::TemplateData entry;
            entry.set("name", term.name);
            entry.set("expression", term.expression);
            lines.push_back(std::move(entry));
        }
        data.set(fmt::format("speed_{}", axis), formula.speed);
    }
    data.set("drive_terms", std::move(lines));
    data.set("time_step", text(time.time_step));
    data.set("steps_per_cycle", std::to_string(time.steps_per_cycle));
    data.set("rayleigh_percent", fmt::format("{:.3g}", 100 * time.rayleigh_fraction));
    data.set("hertz_percent", fmt::format("{:.3g}", 100 * time.contact_fraction));
    data.set("contact_name", s.layer.block != scenario::Block::none
                                 ? "block's"
                                 : std::string(prepare::contact_of(s, 1)->name()));
    data.set("impact_speed", fmt::format("{:.3g}", time.impact_speed));
}

/// What the engine's two computes of contacts are asked for and which of their columns are written: it allows
/// one for the contacts of grains and one for those with walls, so that frames and the largest overlap of
/// phases.csv share them.
void describe_contact_columns(core::TemplateData& data, bool frames) {
    // In the engine's order: two places (6 columns), numbers (3), normal and tangential force (6), overlap.
    constexpr int count = 16;
    constexpr char const* all = "pos id force_normal force_tangential delta";
    auto const columns_of = [](char const* name) {
        std::string columns = fmt::format("c_{}[1]", name);
        for (int column = 2; column <= count; ++column) columns += fmt::format(" c_{}[{}]", name, column);
        return columns;
    };
    data.set("contacts", frames);
    data.set("overlap_words", frames ? all : "delta");
    data.set("floor_contact_words", all);
    data.set("overlap_column", std::to_string(frames ? count : 1));
    data.set("contact_columns", frames ? columns_of("overlaps") : "");
    data.set("trough_contact_columns", frames ? columns_of("floor_contacts") : "");
}

/// How often the layer is sampled within a cycle, and in which bins.
void describe_phases(core::TemplateData& data, prepare::PreparedCase const& n) {
    double const length = n.scenario.layer.length, diameter = mean_diameter(n.scenario);
    int const steps = n.time.steps_per_cycle;
    // A whole number of columns about 1.5 diameters wide, so that the last one is not narrower. Slightly more
    // than the exact width, so that rounding does not add a column at the end of the box.
    double const columns = std::max(1.0, std::round(length / (1.5 * diameter)));
    data.set("samples_per_cycle", std::to_string(prepare::phases_per_cycle));
    data.set("sample_steps", std::to_string(steps / prepare::phases_per_cycle));
    data.set("profile_steps", std::to_string(profile_stride * (steps / profiles_per_cycle)));
    data.set("profile_bin", text(diameter / 2));
    data.set("surface_bin", text(length / columns * (1 + 1e-12)));
}

void describe_output(core::TemplateData& data, scenario::Scenario const& s, prepare::TimeGrid const& time,
                     int packing) {
    bool const frames = writes_frames(s.output, packing);
    data.set("frames", frames);
    if (frames) data.set("frame_steps", std::to_string(time.steps_per_cycle / s.output.frames_per_cycle));
    describe_contact_columns(data, frames && s.output.contacts);
    data.set("max_cycles", std::to_string(s.measure.max_cycles));
    data.set("checkpoints", s.output.checkpoint_cycles > 0);
    data.set("checkpoint_cycles", std::to_string(s.output.checkpoint_cycles));
}

/// The materials of a mixture. Of a layer that keeps its grains, cycles.csv also has the place of the centre
/// of mass of each.
void describe_mixture(core::TemplateData& data, prepare::PreparedCase const& n) {
    std::vector<core::TemplateData> groups;
    std::string columns, values;
    for (int i = 0; n.materials.size() > 1 && i < static_cast<int>(n.materials.size()); ++i) {
        core::TemplateData group;
        group.set("number", std::to_string(i));
        group.set("type", std::to_string(atom_type_of(n, i)));
        groups.push_back(std::move(group));
        if (n.domain.open) continue;
        columns += fmt::format(",x_{0},z_{0}", i);
        values += fmt::format(",${{x_{0}}},${{z_{0}}}", i);
    }
    data.set("mixture", n.materials.size() > 1);
    data.set("kept_mixture", n.materials.size() > 1 && !n.domain.open);
    data.set("material_groups", std::move(groups));
    data.set("material_columns", columns);
    data.set("material_values", values);
}

/// The meshes that move with the trough: the parts of its own mesh with a contact of their own, its walls,
/// and how many meshes there are.
void describe_moving_meshes(core::TemplateData& data, prepare::PreparedCase const& n) {
    std::vector<core::TemplateData> parts, walls;
    auto const add = [](std::vector<core::TemplateData>& list, std::string const& mesh,
                        std::string const& file, int type) {
        core::TemplateData one;
        one.set("mesh", mesh);
        one.set("part_file", file);
        one.set("type", std::to_string(type));
        list.push_back(std::move(one));
    };
    for (std::size_t i = 0; i < n.domain.parts.size(); ++i)
        add(parts, part_mesh(i), part_file(i), atom_type_of_part(n, i));
    // A back wall without side walls stands between the upright sides of the trough's own mesh.
    bool const has_side_walls = n.scenario.trough.side_wall_friction.has_value();
    std::vector<std::string> names;
    if (has_side_walls) names = {"left", "right"};
    if (n.domain.open) names.emplace_back("back");
    for (std::string const& name : names) add(walls, name, name + ".stl", has_side_walls ? 3 : 2);
    std::size_t const count = 1 + parts.size() + walls.size() + (is_fed_screen(n.scenario) ? 1 : 0);
    data.set("several_meshes", count > 1);
    data.set("mesh_count", count > 1 ? std::to_string(count) : std::string());
    data.set("mesh_parts", std::move(parts));
    data.set("wall_meshes", std::move(walls));
}

/// Where the grains are poured, and how long settling may take.
void describe_packing(core::TemplateData& data, prepare::PreparedCase const& n) {
    scenario::Scenario const& s = n.scenario;
    bool const walls = n.domain.is_closed;
    data.set("closed", walls);
    data.set("has_mesh", n.domain.has_mesh());
    data.set("also_small", is_small(n));
    data.set("also_tolerant", n.domain.has_mesh() && smallest_angle_of_mesh(n) < least_angle_of_engine);
    describe_moving_meshes(data, n);
    data.set("mesh_file", s.trough.mesh ? s.trough.mesh->names() : std::string());
    double const extent = n.largest_extent, diameter = mean_diameter(s), step = n.settle_time_step;
    double const fall_time = std::sqrt(2 * n.fill_top / s.trough.gravity);
    double const chunk_time = std::sqrt(diameter / s.trough.gravity);
    double const mean_mass = n.mass / s.layer.grains;
    int const spheres = n.spheres_per_grain;
    data.set("integrator", integrator(s));
    data.set("orientation",
             is_body(s) && s.layer.block == scenario::Block::none ? "orientation random " : "");
    data.set("spheres_per_grain", std::to_string(spheres));
    data.set("settle_time_step", text(step));
    data.set("skin", text(skin_in_diameters * diameter));
    data.set("bottom", text(n.box_bottom));
    data.set("top", text(n.box_top));
    // The box is wider than the side walls, so that the walls are inside it.
    double const beside = n.domain.open ? n.domain.open->box_side : walls ? extent : 0;
    data.set("box_left", text(walls ? -beside : 0));
    data.set("box_right", text(s.layer.width + beside));
    data.set("box_start", text(n.domain.open ? n.domain.open->box_start : 0));
    data.set("box_end", text(n.domain.open ? n.domain.open->box_end : s.layer.length));
    data.set("fill_start", text(n.domain.open ? n.domain.open->feed_start : 0));
    data.set("fill_end", text(n.domain.open ? n.domain.open->feed_end : s.layer.length));
    data.set("settled_grains", std::to_string(n.settled_grains));
    data.set("fill_left", text(walls ? extent / 2 : 0));
    data.set("fill_right", text(s.layer.width - (walls ? extent / 2 : 0)));
    data.set("fill_bottom", text(n.fill_bottom));
    data.set("fill_top", text(n.fill_top));
    data.set("fill_speed", rounded(0.5 * std::sqrt(s.trough.gravity * diameter)));
    data.set("settle_chunk", std::to_string(std::max(1L, std::lround(chunk_time / step))));
    data.set("settle_chunks", std::to_string(static_cast<int>(20 * fall_time / chunk_time) + 200));
    data.set("settle_drag", rounded(mean_mass / (3 * chunk_time * spheres)));
    double const settled_mass = n.domain.open ? n.mass * n.settled_weight / n.weight : n.mass;
    data.set("settled_energy", rounded(height_at_rest(n) * settled_mass * s.trough.gravity));
    data.set("mass", text(n.mass));
    data.set("settled_mass", text(settled_mass));
}

}  // namespace

void describe_gravity(core::TemplateData& data, scenario::Scenario const& s) {
    data.set("gravity", text(s.trough.gravity));
    data.set("gravity_x", text(0 - std::sin(s.trough.inclination)));
    data.set("gravity_z", text(-std::cos(s.trough.inclination)));
}

void describe_settling_gravity(core::TemplateData& data, scenario::Scenario const& s) {
    if (!is_open(s) || s.trough.inclination >= 0) return;
    data.set("gravity", text(s.trough.gravity * std::cos(s.trough.inclination)));
    data.set("gravity_x", "0");
    data.set("gravity_z", "-1");
}

int seed_number(int index) {
    // boost counts primes from 0: prime(1229) = 10007.
    return static_cast<int>(boost::math::prime(static_cast<unsigned>(1229 + index)));
}

core::TemplateData describe(prepare::PreparedCase const& n, PackingPlan const& packing) {
    scenario::Scenario const& s = n.scenario;
    core::TemplateData data;
    std::vector<core::TemplateData> classes = describe_classes(n, packing.number);
    data.set("title",
             fmt::format("Vibrotrough: a granular layer on a vibrating trough, campaign {}", s.campaign));
    data.set("settle_title", "Vibrotrough: a granular layer settles on a trough");
    data.set("class_count", std::to_string(classes.size()));
    data.set("classes", std::move(classes));
    data.set("packing_number", std::to_string(packing.number));
    data.set("seed", std::to_string(seed_number(3 * (packing.number - 1))));
    double const start = packing.start_efficiency.value_or(0);
    data.set("start", packing.start_efficiency.has_value());
    data.set("start_efficiency", text(start));
    data.set("start_speed", rounded(start * n.velocity_scale));
    describe_inputs(data, s);
    data.set("modulus_chosen", n.scenario.grains.is_modulus_chosen);
    describe_contact(data, n);
    describe_packing(data, n);
    describe_drive(data, n);
    describe_output(data, s, n.time, packing.number);
    describe_phases(data, n);
    describe_mixture(data, n);
    return data;
}

}  // namespace vibrotrough::deck
