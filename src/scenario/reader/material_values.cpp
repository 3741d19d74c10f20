#include "scenario/reader/given_values.hpp"

#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::scenario {
namespace {

/// The first key of an entry that is given, to which an error can point.
std::string any_key_of(std::string_view section, std::size_t index, GivenKeys const& given) {
    std::string const start = path_of_entry(section, index, "");
    for (Key const& key : all_keys())
        if (key.path.starts_with(start) && given.has(key.path)) return std::string(key.path);
    return start + "name";
}

/// The names of all materials of grains.
std::vector<std::string> names_of(Scenario const& s) {
    std::vector<std::string> names{first_material};
    for (AddedMaterial const& added : s.materials) names.push_back(added.name);
    return names;
}

void check_name(Scenario const& s, std::size_t index, GivenKeys const& given) {
    std::string const key = path_of_entry(materials_section, index, "name");
    std::string const& name = s.materials[index].name;
    if (name.empty())
        given.fail(any_key_of(materials_section, index, given),
                   fmt::format("number {} of [[materials]] has no name", index + 1),
                   "write name = \"fines\"");
    std::vector<std::string> const names = names_of(s);
    if (std::ranges::count(names, name) > 1)
        given.fail(key, fmt::format("two materials are called '{}'", name),
                   fmt::format("choose another name; that of [grains] is '{}'", first_material));
}

void check_share(Scenario const& s, std::size_t index, GivenKeys const& given) {
    AddedMaterial const& added = s.materials[index];
    if (added.mass_fraction.has_value() == added.number_fraction.has_value())
        given.fail(any_key_of(materials_section, index, given),
                   fmt::format("'{}' needs exactly one of mass_fraction and number_fraction", added.name),
                   "write mass_fraction = 0.2");
    if (added.mass_fraction.has_value() != s.materials.front().mass_fraction.has_value())
        given.fail(any_key_of(materials_section, index, given),
                   "some shares are by mass and some are by number", "give all of them in the same way");
}

/// The shares leave something to the material of [grains].
void check_sum(Scenario const& s, GivenKeys const& given) {
    double sum = 0;
    for (AddedMaterial const& added : s.materials)
        sum += added.mass_fraction.value_or(0) + added.number_fraction.value_or(0);
    if (sum <= 0.9999) return;
    given.fail(any_key_of(materials_section, s.materials.size() - 1, given),
               fmt::format("the shares of [[materials]] sum to {:.6g}", sum),
               "write smaller ones: the rest, which is the share of [grains], must be at least 0.0001");
}

/// What a message says of the solids of a mesh.
std::string solids_to_name(std::vector<std::string> const& parts) {
    constexpr std::size_t most = 10;
    return parts.empty()
               ? ""
               : fmt::format(
                     "; the mesh's solids are: {}{}",
                     fmt::join(parts.begin(),
                               parts.begin() + static_cast<std::ptrdiff_t>(std::min(most, parts.size())),
                               ", "),
                     parts.size() > most ? " ..." : "");
}

/// Some of the mesh must be the trough itself, whose position is measured.
void check_solids(Scenario const& s, GivenKeys const& given) {
    std::vector<std::string> const own = own_parts(s);
    if (own.empty()) return;
    std::string const place = any_key_of(pairs_section, 0, given);
    if (own.size() == s.trough.mesh->parts.size())
        given.fail(place, "every solid of the mesh has coefficients of its own",
                   "leave one of them to trough.friction and trough.restitution");
}

void check_pair(Scenario const& s, std::size_t index, GivenKeys const& given) {
    MaterialPair const& pair = s.pairs[index];
    std::string const place = any_key_of(pairs_section, index, given);
    std::vector<std::string> const names = names_of(s);
    std::vector<std::string> const parts = s.trough.mesh ? s.trough.mesh->parts : std::vector<std::string>();
    auto const is_in = [](std::vector<std::string> const& list, std::string const& name) {
        return std::ranges::find(list, name) != list.end();
    };
    auto const is_part = [&](std::string const& name) { return !is_in(names, name) && is_in(parts, name); };
    auto const is_known = [&](std::string const& name) { return is_in(names, name) || is_part(name); };
    if (pair.materials.size() != 2 || pair.materials[0] == pair.materials[1] ||
        !std::ranges::all_of(pair.materials, is_known) || std::ranges::all_of(pair.materials, is_part))
        given.fail(place,
                   fmt::format("'materials' does not name two different materials of this layer{}",
                               parts.empty() ? "" : ", or one and a solid of the trough's mesh"),
                   fmt::format("write two of {}{}", fmt::join(names, ", "), solids_to_name(parts)));
    for (std::size_t other = 0; other < index; ++other)
        if (std::ranges::is_permutation(s.pairs[other].materials, pair.materials))
            given.fail(place, fmt::format("{} and {} are given twice", pair.materials[0], pair.materials[1]),
                       "write both coefficients into one [[pairs]]");
    if (!pair.friction && !pair.restitution)
        given.fail(place, "gives neither friction nor restitution", "write friction = 0.3");
}

void check_sizes(Scenario const& s, std::size_t index, GivenKeys const& given) {
    constexpr std::size_t most_classes = 100;
    AddedMaterial const& added = s.materials[index];
    if (added.diameter_spread && !added.diameter && s.grains.size_law == SizeLaw::listed) {
        given.fail(path_of_entry(materials_section, index, "diameter_spread"),
                   "is given without a diameter, and the diameters of [grains] are a list",
                   "write diameter as well");
    }
    if (size_classes(s).size() > most_classes) {
        given.fail(any_key_of(materials_section, index, given),
                   fmt::format("the layer has {} sizes of grains, more than {}", size_classes(s).size(),
                               most_classes),
                   "give the materials a diameter of their own, or shorten the list of [grains]");
    }
}

}  // namespace

void complete_materials(Scenario const& s, GivenKeys const& given) {
    for (std::size_t i = 0; i < s.materials.size(); ++i) {
        check_name(s, i, given);
        check_share(s, i, given);
    }
    for (std::size_t i = 0; i < s.pairs.size(); ++i) check_pair(s, i, given);
    check_solids(s, given);
    if (s.materials.empty()) return;
    check_sum(s, given);
    for (std::size_t i = 0; i < s.materials.size(); ++i) check_sizes(s, i, given);
}

}  // namespace vibrotrough::scenario
