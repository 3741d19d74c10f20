#pragma once

#include "core/template.hpp"
#include "prepare/prepared_case.hpp"

#include <string>
#include <vector>

/// @file
/// What the atom types of a deck stand for, and the tables of the contacts between them.

namespace vibrotrough::deck {

/// One atom type of the engine.
struct AtomType {
    /// What a type can stand for.
    enum class Kind {
        grains,     ///< of one material
        trough,     ///< its floor or mesh
        part,       ///< a part of the mesh with a contact of its own
        side_wall,  ///< the side walls beside a flat floor or the mesh of an open trough
    };
    Kind kind;                                     ///< what it stands for
    scenario::Material const* material = nullptr;  ///< of grains
    std::string name;                              ///< of the material or part, "trough" or "side walls"
};

/// The types in the order of their numbers, which begin with 1: the material of [grains], the trough, the
/// side walls if there are any, the other materials, and the parts of a mesh with a contact of their own.
/// They refer to the case.
std::vector<AtomType> atom_types(prepare::PreparedCase const& prepared);

/// The number of a material's atom type.
/// @param material  index in PreparedCase::materials
int atom_type_of(prepare::PreparedCase const& prepared, int material);

/// The number of the atom type of a part of the trough's mesh.
/// @param part  index in PreparedCase::domain.parts
int atom_type_of_part(prepare::PreparedCase const& prepared, std::size_t part);

/// Friction and restitution of all pairs of types, row by row, as the engine takes them. It requires values
/// also for pairs that never touch.
struct PairTables {
    std::string frictions;     ///< coefficients of friction
    std::string restitutions;  ///< nominal coefficients of restitution
};

/// The tables of a case.
PairTables pair_tables(prepare::PreparedCase const& prepared);

/// What the templates say of the contacts: models, materials and tables.
void describe_contact(core::TemplateData& data, prepare::PreparedCase const& prepared);

}  // namespace vibrotrough::deck
