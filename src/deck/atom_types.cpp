#include "deck/atom_types.hpp"

#include "prepare/contact.hpp"

#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::deck {
namespace {

using enum AtomType::Kind;

/// A contact with the trough or a side wall, or one that never happens: the trough with itself.
scenario::ContactCoefficients contact_with_wall(scenario::Scenario const& s, AtomType const& one,
                                                AtomType const& other) {
    scenario::Material const* const grains = one.material != nullptr ? one.material : other.material;
    double const restitution = grains != nullptr ? grains->trough_restitution : s.trough.restitution;
    if (one.kind == side_wall || other.kind == side_wall)
        return {s.trough.side_wall_friction.value_or(0), restitution};
    if (grains == nullptr) return {s.trough.friction, restitution};
    AtomType const& wall = one.material != nullptr ? other : one;
    if (wall.kind == part) return contact_with_trough(s, *grains, wall.name);
    return {grains->trough_friction, restitution};
}

}  // namespace

std::vector<AtomType> atom_types(prepare::PreparedCase const& prepared) {
    std::vector<AtomType> types;
    for (scenario::Material const& material : prepared.materials) {
        types.push_back({grains, &material, material.name});
        if (types.size() > 1) continue;
        types.push_back({trough, nullptr, "trough"});
        if (prepared.scenario.trough.side_wall_friction) types.push_back({side_wall, nullptr, "side walls"});
    }
    for (prepare::TroughPart const& one : prepared.domain.parts) types.push_back({part, nullptr, one.name});
    return types;
}

int atom_type_of(prepare::PreparedCase const& prepared, int material) {
    int const walls = prepared.scenario.trough.side_wall_friction ? 2 : 1;
    return material == 0 ? 1 : material + 1 + walls;
}

int atom_type_of_part(prepare::PreparedCase const& prepared, std::size_t part) {
    return atom_type_of(prepared, static_cast<int>(prepared.materials.size() + part));
}

PairTables pair_tables(prepare::PreparedCase const& prepared) {
    std::vector<AtomType> const types = atom_types(prepared);
    std::vector<std::string> frictions, restitutions;
    for (AtomType const& one : types) {
        for (AtomType const& other : types) {
            bool const are_grains = one.material != nullptr && other.material != nullptr;
            scenario::ContactCoefficients const contact =
                are_grains ? contact_of(prepared.scenario, *one.material, *other.material)
                           : contact_with_wall(prepared.scenario, one, other);
            frictions.push_back(fmt::format("{}", contact.friction));
            restitutions.push_back(fmt::format("{:.6g}", prepare::nominal_restitution(contact.restitution)));
        }
    }
    return {fmt::format("{}", fmt::join(frictions, " ")), fmt::format("{}", fmt::join(restitutions, " "))};
}

namespace {

std::string exact(double number) {
    return fmt::format("{}", number);
}

std::string repeated(int times, double value) {
    return fmt::format(
        "{}", fmt::join(std::vector<std::string>(static_cast<std::size_t>(times), exact(value)), " "));
}

/// The materials other than that of [grains], for the head of the decks.
std::vector<core::TemplateData> describe_materials(prepare::PreparedCase const& n) {
    std::vector<core::TemplateData> list;
    for (std::size_t i = 1; i < n.materials.size(); ++i) {
        scenario::Material const& material = n.materials[i];
        core::TemplateData entry;
        entry.set("name", material.name);
        entry.set("type", std::to_string(atom_type_of(n, static_cast<int>(i))));
        entry.set("density", exact(material.grains.density));
        entry.set("friction", exact(material.grains.friction));
        entry.set("restitution", exact(material.grains.restitution));
        entry.set("trough_friction", exact(material.trough_friction));
        entry.set("trough_restitution", exact(material.trough_restitution));
        list.push_back(std::move(entry));
    }
    return list;
}

void describe_block_contact(core::TemplateData& data, prepare::PreparedCase const& n, int types) {
    scenario::Scenario const& s = n.scenario;
    prepare::BlockContact const contact = prepare::block_contact(s, n.mass, n.spheres_per_grain);
    data.set("contact_stiffness", fmt::format("{:.6g}", contact.stiffness));
    data.set("contact_stiffnesses", repeated(types * types, contact.stiffness));
    data.set("contact_dampings", repeated(types * types, contact.damping));
}

}  // namespace

void describe_contact(core::TemplateData& data, prepare::PreparedCase const& n) {
    scenario::Scenario const& s = n.scenario;
    bool const block = s.layer.block != scenario::Block::none,
               rolls = s.grains.rotation == scenario::Rotation::rolling;
    std::vector<AtomType> const all_types = atom_types(n);
    int const types = static_cast<int>(all_types.size());
    std::vector<std::string> type_names;
    for (int type = 2; type <= types; ++type)
        type_names.push_back(
            fmt::format("type {}: {}", type, all_types[static_cast<std::size_t>(type) - 1].name));
    PairTables const tables = pair_tables(n);
    std::string const model = block ? "hooke/stiffness tangential no_history"
                                    : fmt::format("{} tangential history", name_of(s.engine.contact));
    std::string const attraction = s.engine.cohesion > 0 ? " cohesion sjkr" : "";
    std::string const options = fmt::format("limitForce {} tangential_damping {}",
                                            s.layer.block == scenario::Block::plate ? "off" : "on",
                                            block || s.engine.tangential_damping ? "on" : "off");
    std::string const wall_model = model + attraction + (rolls ? " rolling_friction epsd2" : "");
    data.set("block", block);
    data.set("rolls", rolls);
    data.set("types", std::to_string(types));
    data.set("other_types", fmt::format("{}", fmt::join(type_names, ", ")));
    data.set("materials", describe_materials(n));
    data.set(std::string(name_of(s.engine.contact)), !block);
    data.set("also_" + std::string(name_of(s.engine.contact)), !block);  // of a model that is new
    data.set("coheres", s.engine.cohesion > 0);
    data.set("cohesion", exact(s.engine.cohesion));
    data.set("cohesions", repeated(types * types, s.engine.cohesion));
    data.set("wall_model", wall_model);
    data.set("gate_model", wall_model);
    data.set("contact_options", options);
    data.set("contact_model", wall_model + " " + options);
    data.set("youngs_moduli", repeated(types, s.grains.youngs_modulus.value()));
    data.set("poisson_ratios", repeated(types, s.grains.poisson_ratio));
    data.set("soft",
             !block &&
                 s.grains.youngs_modulus.value() < 5e6);  // LIGGGHTS then requires the command soft_particles
    data.set("hard", !block && s.grains.youngs_modulus.value() > 1e9);  // or the command hard_particles
    data.set("restitutions", tables.restitutions);
    data.set("frictions", tables.frictions);
    data.set("rolling_frictions", repeated(types * types, s.grains.rolling_friction));
    if (block) describe_block_contact(data, n, types);
}

}  // namespace vibrotrough::deck
