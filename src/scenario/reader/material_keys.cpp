#include "scenario/reader/key_fields.hpp"

#include <utility>

namespace vibrotrough::scenario {
namespace {

using enum KeyKind;
using enum KeyNeed;

template <std::size_t index>
void add_material(std::vector<Key>& rows) {
    auto const path = [](std::string_view name) { return path_of_entry(materials_section, index, name); };
    constexpr auto list = &Scenario::materials;
    auto const add = [&](std::string_view name, KeyKind kind, std::string_view unit, double least,
                         double most, std::string_view range, std::string_view example,
                         std::string_view meaning, KeyAccess access) {
        rows.push_back({path(name), kind, unit, least, most, range, "", optional, example, meaning, access});
    };
    add("name", KeyKind::name, "", 0, 0, "1 to 100 letters, digits, '.', '_' or '-'", "\"fines\"",
        "name of a further material of grains, which is mixed with that of [grains]; what an entry does not "
        "give is as in [grains] and [trough]",
        entry_field<list, index, &AddedMaterial::name>);
    add("mass_fraction", number, "", 0.0001, 0.9999, "0.0001 to 0.9999", "0.2",
        "its share of the mass of the layer; the material of [grains] is the rest",
        entry_field<list, index, &AddedMaterial::mass_fraction>);
    add("number_fraction", number, "", 0.0001, 0.9999, "0.0001 to 0.9999", "0.2",
        "its share of the number of grains, instead of mass_fraction",
        entry_field<list, index, &AddedMaterial::number_fraction>);
    add("diameter", quantity, "m", 1e-6, 1, "1 um to 1 m", "\"2 mm\"", "d, as grains.diameter",
        entry_field<list, index, &AddedMaterial::diameter>);
    add("diameter_spread", number, "", 0, 0.5, "0 to 0.5", "0.1", "s, as grains.diameter_spread",
        entry_field<list, index, &AddedMaterial::diameter_spread>);
    add("density", quantity, "kg/m3", 1, 3e4, "1 to 30000 kg/m3", "\"2500 kg/m3\"", "density of its grains",
        entry_field<list, index, &AddedMaterial::density>);
    add("friction", number, "", 0, 5, "0 to 5", "0.4",
        "friction coefficient of the material on itself; on another material it is the harmonic mean of "
        "both, "
        "unless a [[pairs]] says otherwise",
        entry_field<list, index, &AddedMaterial::friction>);
    add("restitution", number, "", 0.05001, 1, "above 0.05, to 1", "0.6",
        "coefficient of restitution of the material on itself; on another material as for friction",
        entry_field<list, index, &AddedMaterial::restitution>);
    add("trough_friction", number, "", 0, 5, "0 to 5", "0.3", "mu, friction coefficient on the trough",
        entry_field<list, index, &AddedMaterial::trough_friction>);
    add("trough_restitution", number, "", 0.05001, 1, "above 0.05, to 1", "0.6",
        "e, coefficient of restitution on the trough",
        entry_field<list, index, &AddedMaterial::trough_restitution>);
}

template <std::size_t index>
void add_pair(std::vector<Key>& rows) {
    auto const path = [](std::string_view name) { return path_of_entry(pairs_section, index, name); };
    constexpr auto list = &Scenario::pairs;
    rows.push_back({path("materials"), texts, "", 0, 0,
                    "two names of materials; \"grains\" is that of [grains]", "", optional,
                    "[\"grains\", \"fines\"]",
                    "two materials whose contacts are given; one may be a solid of the trough's mesh",
                    entry_field<list, index, &MaterialPair::materials>});
    rows.push_back({path("friction"), number, "", 0, 5, "0 to 5", "", optional, "0.3",
                    "friction coefficient of one on the other",
                    entry_field<list, index, &MaterialPair::friction>});
    rows.push_back({path("restitution"), number, "", 0.05001, 1, "above 0.05, to 1", "", optional, "0.4",
                    "coefficient of restitution of one on the other",
                    entry_field<list, index, &MaterialPair::restitution>});
}

}  // namespace

std::span<Key const> material_keys() {
    static std::vector<Key> const all = [] {
        std::vector<Key> rows;
        [&]<std::size_t... i>(std::index_sequence<i...>) {
            (add_material<i>(rows), ...);
        }
        (std::make_index_sequence<most_added_materials>());
        [&]<std::size_t... i>(std::index_sequence<i...>) {
            (add_pair<i>(rows), ...);
        }
        (std::make_index_sequence<most_pairs>());
        return rows;
    }();
    return all;
}

}  // namespace vibrotrough::scenario
