#include "scenario/reader/key_fields.hpp"

#include <array>

namespace vibrotrough::scenario {
namespace {

using enum KeyKind;
using enum KeyNeed;

template <auto member>
constexpr KeyAccess of_material = entry_field<&Scenario::materials, member>;

template <auto member>
constexpr KeyAccess of_pair = entry_field<&Scenario::pairs, member>;

constexpr std::array rows_of_materials{
    Key{"name", KeyKind::name, "", 0, 0, "1 to 100 letters, digits, '.', '_' or '-'", "", optional,
        "\"fines\"",
        "name of a further material of grains, which is mixed with that of [grains]; what an entry does not "
        "give is as in [grains] and [trough]",
        of_material<&AddedMaterial::name>},
    Key{"mass_fraction", number, "", 0.0001, 0.9999, "", "", optional, "0.2",
        "its share of the mass of the layer; the material of [grains] is the rest",
        of_material<&AddedMaterial::mass_fraction>},
    Key{"number_fraction", number, "", 0.0001, 0.9999, "", "", optional, "0.2",
        "its share of the number of grains, instead of mass_fraction",
        of_material<&AddedMaterial::number_fraction>},
    Key{"diameter", quantity, "m", 1e-6, 1, "1 um to 1 m", "", optional, "\"2 mm\"", "d, as grains.diameter",
        of_material<&AddedMaterial::diameter>},
    Key{"diameter_spread", number, "", 0, 0.5, "", "", optional, "0.1", "s, as grains.diameter_spread",
        of_material<&AddedMaterial::diameter_spread>},
    Key{"density", quantity, "kg/m3", 1, 3e4, "1 to 30000 kg/m3", "", optional, "\"2500 kg/m3\"",
        "density of its grains", of_material<&AddedMaterial::density>},
    Key{"friction", number, "", 0, 5, "", "", optional, "0.4",
        "friction coefficient of the material on itself; on another material it is the harmonic mean of "
        "both, "
        "unless a [[pairs]] says otherwise",
        of_material<&AddedMaterial::friction>},
    Key{"restitution", number, "", 0.05001, 1, "above 0.05, to 1", "", optional, "0.6",
        "coefficient of restitution of the material on itself; on another material as for friction",
        of_material<&AddedMaterial::restitution>},
    Key{"trough_friction", number, "", 0, 5, "", "", optional, "0.3",
        "mu, friction coefficient on the trough", of_material<&AddedMaterial::trough_friction>},
    Key{"trough_restitution", number, "", 0.05001, 1, "above 0.05, to 1", "", optional, "0.6",
        "e, coefficient of restitution on the trough", of_material<&AddedMaterial::trough_restitution>},
};

constexpr std::array rows_of_pairs{
    Key{"materials", texts, "", 0, 0, "two names of materials; \"grains\" is that of [grains]", "", optional,
        "[\"grains\", \"fines\"]",
        "two materials whose contacts are given; one may be a solid of the trough's mesh",
        of_pair<&MaterialPair::materials>},
    Key{"friction", number, "", 0, 5, "", "", optional, "0.3", "friction coefficient of one on the other",
        of_pair<&MaterialPair::friction>},
    Key{"restitution", number, "", 0.05001, 1, "above 0.05, to 1", "", optional, "0.4",
        "coefficient of restitution of one on the other", of_pair<&MaterialPair::restitution>},
};

}  // namespace

std::span<Key const> material_keys() {
    return rows_of_materials;
}

std::span<Key const> pair_keys() {
    return rows_of_pairs;
}

}  // namespace vibrotrough::scenario
