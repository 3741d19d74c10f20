#include "engine/probe_decks.hpp"

#include "core/hash.hpp"
#include "deck/drive_formula.hpp"
#include "deck/render.hpp"
#include "deck/trough_mesh.hpp"
#include "engine/three_grains.hpp"
#include "scenario/model/scenario.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace vibrotrough::engine {
namespace {

/// Version of probe_verdicts. Increase it with every change there, so that certificates are made again.
constexpr int judgement = 1;

constexpr double diameter = 0.003;
constexpr double side = 0.1;  // m, side of the square floor of the impact and incline decks
constexpr double grain_friction = 0.5;

using core::TemplateData;

std::string text(double number) {
    return fmt::format("{}", number);
}

std::string repeated(double value, std::size_t times) {
    std::string list;
    for (std::size_t i = 0; i < times; ++i) list += fmt::format("{}{}", i == 0 ? "" : " ", value);
    return list;
}

/// A symmetric matrix of `among`, except for the last row and column, which hold the contacts with the floor.
std::string pair_matrix(double among, std::vector<double> const& with_floor) {
    std::size_t const n = with_floor.size();
    std::string list;
    for (std::size_t i = 0; i <= n; ++i) {
        for (std::size_t j = 0; j <= n; ++j) {
            double const value = i == j || std::max(i, j) < n ? among : with_floor[std::min(i, j)];
            list += fmt::format("{}{}", list.empty() ? "" : " ", value);
        }
    }
    return list;
}

TemplateData data_of(std::map<std::string, std::string> const& values) {
    TemplateData data;
    for (auto const& [name, value] : values) data.set(name, value);
    return data;
}

/// One grain type per element of the lists, which are of equal length.
TemplateData world(std::string const& title, double time_step, std::vector<double> const& restitutions,
                   std::vector<double> const& frictions) {
    ContactMaterial const material = probe_material(0.5, grain_friction);
    std::size_t const types = restitutions.size() + 1;
    return data_of({{"title", "Vibrotrough probes the engine: " + title},
                    {"floor_type", std::to_string(types)},
                    {"length", text(side)},
                    {"width", text(side)},
                    {"bottom", "-0.02"},
                    {"top", "0.06"},
                    {"skin", text(0.3 * diameter)},
                    {"time_step", text(time_step)},
                    {"moduli", repeated(material.youngs_modulus, types)},
                    {"poisson_ratios", repeated(material.poisson_ratio, types)},
                    {"restitutions", pair_matrix(0.5, restitutions)},
                    {"frictions", pair_matrix(grain_friction, frictions)},
                    {"diameter", text(diameter)},
                    {"density", text(material.density)},
                    {"gravity", text(scenario::gravity)}});
}

std::vector<Impact> impacts(std::vector<std::array<double, 2>> const& speeds,
                            std::vector<double> const& gaps) {
    std::vector<Impact> list;
    for (auto const& [normal, tangential] : speeds) {
        for (double const gap : gaps) {
            for (int type = 1; type <= static_cast<int>(probed_restitutions.size()); ++type) {
                list.push_back({type, normal, tangential, gap});
            }
        }
    }
    return list;
}

ProbeDeck impact_deck(std::string const& name, std::vector<Impact> const& list, double time_step,
                      double duration) {
    std::vector<double> const restitutions(probed_restitutions.begin(), probed_restitutions.end());
    TemplateData values = world("impacts, " + name, time_step, restitutions,
                                std::vector<double>(restitutions.size(), impact_friction));
    values.set("steps", std::to_string(std::lround(duration / time_step)));
    std::vector<TemplateData> grains;
    for (std::size_t i = 0; i < list.size(); ++i) {
        // Away from the nodes and edges of the mesh, and 3 diameters apart so that grains do not touch each
        // other.
        double const x = 0.0071 + 0.009 * static_cast<double>(i % 10),
                     y = 0.0053 + 0.009 * static_cast<double>(i / 10);
        grains.push_back(data_of({{"id", std::to_string(i + 1)},
                                  {"type", std::to_string(list[i].type)},
                                  {"x", text(x)},
                                  {"y", text(y)},
                                  {"z", text(diameter / 2 + list[i].gap)},
                                  {"vx", text(list[i].tangential_speed)},
                                  {"vz", text(-list[i].normal_speed)}}));
    }
    values.set("grains", grains);
    return {name,
            {{"in.liggghts", deck::render_template("probes/impact", values)},
             {"trough.stl", deck::flat_trough_stl(side, side, side / 5)}}};
}

/// The values and lists that the campaigns' own templates `trough` and `drive` want.
void add_campaign_values(TemplateData& values, MovingTrough const& motion) {
    scenario::Trough trough{};
    trough.amplitude = std::hypot(motion.amplitude_x, motion.amplitude_z);
    trough.vibration_angle = std::atan2(motion.amplitude_z, motion.amplitude_x);
    trough.frequency = 1 / motion.period;
    scenario::DriveMotion const drive = drive_motion(trough);
    std::vector<TemplateData> lines;
    for (auto const& [axis, terms] :
         {std::pair{std::string("x"), &drive.along}, std::pair{std::string("z"), &drive.normal}}) {
        deck::DriveFormula const formula = deck::drive_formula(*terms, axis);
        for (deck::Formula const& term : formula.terms)
            lines.push_back(data_of({{"name", term.name}, {"expression", term.expression}}));
        values.set(fmt::format("speed_{}", axis), formula.speed);
    }
    values.set("drive_terms", lines);
    values.set("steps_per_cycle", std::to_string(motion.steps));
    values.set("wall_model", "hertz tangential history");
    values.set("contact_options", "limitForce on tangential_damping off");
}

ProbeDeck motion_deck(std::string const& name, MovingTrough const& motion,
                      std::vector<TemplateData> const& grains) {
    constexpr double length = 0.036, width = 0.018;
    TemplateData values = world(name, motion.period / motion.steps, {0.5}, {grain_friction});
    values.set("grains", grains);
    add_campaign_values(values, motion);
    values.set("length", text(length));
    values.set("width", text(width));
    values.set("steps", std::to_string(motion.steps));
    return {name,
            {{"in.liggghts", deck::render_template("probes/trough", values)},
             {"trough.stl", deck::flat_trough_stl(length, width, 3 * diameter)}}};
}

}  // namespace

double rayleigh_time(ContactMaterial const& m) {
    double const shear_modulus = m.youngs_modulus / (2 * (1 + m.poisson_ratio));
    return std::numbers::pi * m.radius * std::sqrt(m.density / shear_modulus) /
           (0.1631 * m.poisson_ratio + 0.8766);
}

TemplateData probe_world(std::string const& title, double time_step) {
    return world(title, time_step, {0.5}, {grain_friction});
}

ContactMaterial probe_material(double restitution, double friction) {
    return {diameter / 2, 1400, 5e6, 0.35, restitution, friction};
}

std::vector<Impact> const& fine_impacts() {
    // Normal impacts; impacts so oblique that the contact slides throughout; impacts so steep that it grips.
    static auto const list = impacts({{0.5, 0}, {0.25, 0.5}, {0.25, 0.1}}, {1e-5});
    return list;
}

std::vector<Impact> const& coarse_impacts() {
    // The initial gap determines where in a step the contact begins.
    static auto const list = impacts({{0.5, 0}, {0.25, 0.5}, {0.25, 0.1}}, {1.0e-5, 1.3e-5, 1.6e-5, 2.3e-5});
    return list;
}

double resting_overlap(double inclination) {
    ContactMaterial const material = probe_material(0.5, grain_friction);
    return hertz_overlap(material, sphere_mass(material) * scenario::gravity * std::cos(inclination));
}

MovingTrough sliding_trough() {
    return {.amplitude_x = 0.0052, .amplitude_z = 0, .grains = 28};
}

MovingTrough flying_trough() {
    return {.amplitude_x = 0.0052, .amplitude_z = 0.003, .grains = 1};
}

ProbeDeck fine_impact_deck() {
    return impact_deck("impact", fine_impacts(), 5e-7, 1e-3);
}

ProbeDeck coarse_impact_deck() {
    return impact_deck("impact-coarse", coarse_impacts(), 0.2 * rayleigh_time(probe_material(0.5, 0.5)),
                       2e-3);
}

ProbeDeck incline_deck() {
    Incline const incline;
    TemplateData values =
        world("incline", incline.time_step, {0.5, 0.5}, {incline.holding_friction, incline.sliding_friction});
    values.set("inclination_deg", fmt::format("{:.6g}", incline.angle * 180 / std::numbers::pi));
    values.set("gravity_x", text(std::sin(incline.angle)));
    values.set("gravity_z", text(-std::cos(incline.angle)));
    values.set("steps", std::to_string(incline.steps));
    values.set("sample_steps", std::to_string(incline.sample_steps));
    std::vector<TemplateData> grains;
    for (int const id : {1, 2, 3}) {
        grains.push_back(data_of({{"type", id == 2 ? "2" : "1"},
                                  {"x", "0.0071"},
                                  {"y", text(0.0053 + 0.012 * id)},
                                  {"z", text(diameter / 2 - resting_overlap(incline.angle))}}));
    }
    values.set("grains", grains);
    return {"incline",
            {{"in.liggghts", deck::render_template("probes/incline", values)},
             {"trough.stl", deck::flat_trough_stl(side, side, side / 5)}}};
}

ProbeDeck contact_deck() {
    std::vector<TemplateData> grains;
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 7; ++column) {
            // Seven to the length and four to the width are not the mesh's numbers: the moving mesh passes
            // under the grains with its edges, diagonals and seams at the periodic faces.
            grains.push_back(data_of({{"type", "1"},
                                      {"x", text(0.00017 + 0.0051 * column + 0.0003 * row)},
                                      {"y", text(0.00013 + 0.0045 * row)},
                                      {"z", text(diameter / 2 - resting_overlap(0))}}));
        }
    }
    return motion_deck("contact", sliding_trough(), grains);
}

ProbeDeck drive_deck() {
    // One grain outside the reach of the trough: the engine does not run without any grain.
    return motion_deck("drive", flying_trough(),
                       {data_of({{"type", "1"}, {"x", "0.01"}, {"y", "0.01"}, {"z", "0.03"}})});
}

ProbeDeck speed_deck(int steps) {
    constexpr double length = 12 * diameter, width = 6 * diameter;
    double const time_step = 0.2 * rayleigh_time(probe_material(0.5, 0.5));
    TemplateData values = world("speed", time_step, {0.5}, {0.23});
    add_campaign_values(values, {.amplitude_x = 0.0052,
                                 .amplitude_z = 0.003,
                                 .period = 3000 * time_step,
                                 .steps = 3000,
                                 .grains = 0});
    values.set("length", text(length));
    values.set("width", text(width));
    values.set("top", "0.2");
    values.set("spacing", text(diameter));
    values.set("layer_top", text(14 * diameter - 1e-6));
    values.set("jitter", text(0.1 * diameter));  // so that columns of grains do not stand
    values.set("lift", text(0.51 * diameter));
    values.set("fall_speed", "-0.1");
    values.set("steps", std::to_string(steps));
    return {fmt::format("speed-{}", steps),
            {{"in.liggghts", deck::render_template("probes/speed", values)},
             {"trough.stl", deck::flat_trough_stl(length, width, 3 * diameter)}}};
}

std::string digest_of_probes() {
    std::string all = std::to_string(judgement);
    for (ProbeDeck const& deck : {fine_impact_deck(), coarse_impact_deck(), incline_deck(), contact_deck(),
                                  drive_deck(), gap_roll_deck(), nip_deck(), speed_deck(1)}) {
        for (auto const& [name, content] : deck.files) all += name + content;
    }
    return core::sha256_hex(all);
}

}  // namespace vibrotrough::engine
