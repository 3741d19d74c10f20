#include "deck/atom_types.hpp"

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
            restitutions.push_back(fmt::format("{}", contact.restitution));
        }
    }
    return {fmt::format("{}", fmt::join(frictions, " ")), fmt::format("{}", fmt::join(restitutions, " "))};
}

}  // namespace vibrotrough::deck
