#include "scenario/model/materials.hpp"

#include "scenario/model/scenario.hpp"

#include <algorithm>
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
double weighted(std::vector<Material> const& all, double (*weight)(Material const&),
                double (*number)(Material const&)) {
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
    ContactCoefficients contact{harmonic_mean(one.grains.friction, other.grains.friction),
                                harmonic_mean(one.grains.restitution, other.grains.restitution)};
    for (MaterialPair const& pair : s.pairs) {
        bool const is_this = std::ranges::is_permutation(pair.materials, std::vector{one.name, other.name});
        if (!is_this) continue;
        contact.friction = pair.friction.value_or(contact.friction);
        contact.restitution = pair.restitution.value_or(contact.restitution);
    }
    return contact;
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
    if (s.materials.empty()) return s.trough.friction;
    return weighted(materials(s), mass_of_grain, [](Material const& m) { return m.trough_friction; });
}

}  // namespace vibrotrough::scenario
