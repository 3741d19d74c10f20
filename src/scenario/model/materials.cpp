#include "scenario/model/materials.hpp"

#include "scenario/model/scenario.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>

namespace vibrotrough::scenario {
namespace {

Material first_of(Scenario const& s) {
    return {first_material, s.grains, s.trough.friction, s.trough.restitution, 1};
}

Grains grains_of(AddedMaterial const& added, Grains grains) {
    if (added.diameter) {
        grains.diameter = *added.diameter;
        grains.diameter_spread = grains.size_law == SizeLaw::listed ? 0 : grains.diameter_spread;
        if (grains.size_law == SizeLaw::listed) grains.size_law = SizeLaw::three_classes;
    }
    grains.diameter_spread = added.diameter_spread.value_or(grains.diameter_spread);
    grains.density = added.density.value_or(grains.density);
    grains.friction = added.friction.value_or(grains.friction);
    grains.restitution = added.restitution.value_or(grains.restitution);
    return grains;
}

double mass_of_grain(Material const& material) {
    return material.grains.density * mean_grain_volume(material.grains);
}

/// The mean of a number over the materials, weighted with their share of the volume or of the mass.
template <typename Number>
double weighted(std::vector<Material> const& all, double (*weight)(Material const&), Number const& number) {
    double sum = 0, weights = 0;
    for (Material const& material : all) {
        double const w = material.number_fraction * weight(material);
        sum += w * number(material);
        weights += w;
    }
    return sum / weights;
}

double volume_of_grain(Material const& material) {
    return mean_grain_volume(material.grains);
}

/// Shares by mass become shares by number: a share of the mass has as many grains as its mass divided by
/// the mean mass of a grain.
void share_numbers(std::vector<Material>& all, std::vector<AddedMaterial> const& added) {
    bool const by_mass = added.front().mass_fraction.has_value();
    double first = 1, sum = 0;
    for (std::size_t i = 0; i < added.size(); ++i) {
        double const share = (by_mass ? added[i].mass_fraction : added[i].number_fraction).value_or(0);
        all[i + 1].number_fraction = share;
        first -= share;
    }
    all.front().number_fraction = first;
    for (Material& material : all) {
        if (by_mass) material.number_fraction /= mass_of_grain(material);
        sum += material.number_fraction;
    }
    for (Material& material : all) material.number_fraction /= sum;
}

/// These coefficients, or what the campaign file gives for this pair of names.
ContactCoefficients with_pair(Scenario const& s, std::string_view one, std::string_view other,
                              ContactCoefficients contact) {
    for (MaterialPair const& pair : s.pairs) {
        if (!std::ranges::is_permutation(pair.materials, std::array{one, other})) continue;
        contact.friction = pair.friction.value_or(contact.friction);
        contact.restitution = pair.restitution.value_or(contact.restitution);
    }
    return contact;
}

/// The friction of a material on the trough, as the mean over the trough in plan.
double mean_over_trough(Scenario const& s, std::vector<std::string> const& parts, Material const& material) {
    double mean = material.trough_friction;
    for (std::string const& part : parts)
        mean += s.trough.mesh->share_in_plan(part) *
                (contact_with_trough(s, material, part).friction - material.trough_friction);
    return mean;
}

}  // namespace

std::vector<Material> materials(Scenario const& s) {
    std::vector<Material> all{first_of(s)};
    for (AddedMaterial const& added : s.materials) {
        all.push_back({added.name, grains_of(added, s.grains),
                       added.trough_friction.value_or(s.trough.friction),
                       added.trough_restitution.value_or(s.trough.restitution), 0});
    }
    if (!s.materials.empty()) share_numbers(all, s.materials);
    return all;
}

double harmonic_mean(double a, double b) {
    return a == b ? a : 2 * a * b / (a + b);
}

ContactCoefficients contact_of(Scenario const& s, Material const& one, Material const& other) {
    return with_pair(s, one.name, other.name,
                     {harmonic_mean(one.grains.friction, other.grains.friction),
                      harmonic_mean(one.grains.restitution, other.grains.restitution)});
}

std::vector<std::string> own_parts(Scenario const& s) {
    std::vector<std::string> own;
    if (!s.trough.mesh) return own;
    auto const is_material = [&](std::string const& name) {
        return name == first_material ||
               std::ranges::find(s.materials, name, &AddedMaterial::name) != s.materials.end();
    };
    for (std::string const& part : s.trough.mesh->parts)
        if (!is_material(part) && std::ranges::any_of(s.pairs, [&](MaterialPair const& pair) {
                return std::ranges::find(pair.materials, part) != pair.materials.end();
            }))
            own.push_back(part);
    return own;
}

ContactCoefficients contact_with_trough(Scenario const& s, Material const& material, std::string_view part) {
    return with_pair(s, material.name, part, {material.trough_friction, material.trough_restitution});
}

std::vector<MixtureClass> size_classes(Scenario const& s) {
    std::vector<MixtureClass> classes;
    int index = 0;
    for (Material const& material : materials(s)) {
        for (SizeClass const& size : size_classes(material.grains))
            classes.push_back({size.diameter, material.number_fraction * size.number_fraction, index});
        ++index;
    }
    std::ranges::stable_sort(classes, std::greater(), &MixtureClass::diameter);
    return classes;
}

double largest_diameter(Scenario const& s) {
    return size_classes(s).front().diameter;
}

double smallest_diameter(Scenario const& s) {
    return size_classes(s).back().diameter;
}

double mean_grain_volume(Scenario const& s) {
    if (s.materials.empty()) return mean_grain_volume(s.grains);
    std::vector<Material> const all = materials(s);
    return std::accumulate(all.begin(), all.end(), 0.0, [](double sum, Material const& material) {
        return sum + material.number_fraction * volume_of_grain(material);
    });
}

double mean_diameter(Scenario const& s) {
    if (s.materials.empty()) return s.grains.diameter;
    return weighted(materials(s), volume_of_grain, [](Material const& m) { return m.grains.diameter; });
}

double mean_density(Scenario const& s) {
    if (s.materials.empty()) return s.grains.density;
    return weighted(materials(s), volume_of_grain, [](Material const& m) { return m.grains.density; });
}

double mean_trough_friction(Scenario const& s) {
    std::vector<std::string> const parts = own_parts(s);
    if (s.materials.empty() && parts.empty()) return s.trough.friction;
    return weighted(materials(s), mass_of_grain,
                    [&](Material const& m) { return mean_over_trough(s, parts, m); });
}

double mean_trough_restitution(Scenario const& s) {
    if (s.materials.empty()) return s.trough.restitution;
    return weighted(materials(s), mass_of_grain, [](Material const& m) { return m.trough_restitution; });
}

}  // namespace vibrotrough::scenario
