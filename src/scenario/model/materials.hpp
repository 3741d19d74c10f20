#pragma once

#include "scenario/model/grains.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// @file
/// Layers of several materials: [grains] is the first material, and each [[materials]] adds another one.

namespace vibrotrough::scenario {

struct Scenario;

/// A material that is mixed into the layer, as the campaign file gives it. What it does not give is that of
/// the grains. Rotation, rolling friction, shape and elastic constants are those of the grains, too.
struct AddedMaterial {
    std::string name;                               ///< unlike those of the other materials
    std::optional<double> diameter = {};            ///< m
    std::optional<double> diameter_spread = {};     ///< s, see Grains
    std::optional<double> density = {};             ///< kg/m^3
    std::optional<double> friction = {};            ///< coefficient of the material on itself
    std::optional<double> restitution = {};         ///< coefficient of the material on itself
    std::optional<double> trough_friction = {};     ///< coefficient of the material on the trough
    std::optional<double> trough_restitution = {};  ///< coefficient of the material on the trough
    std::optional<double> number_fraction = {};     ///< of all grains of the layer
    std::optional<double> mass_fraction = {};       ///< of the mass of the layer
};

/// How grains of two materials touch, where it differs from the rule of contact_of(), or how grains touch a
/// part of the trough's mesh, where it differs from the trough.
struct MaterialPair {
    std::vector<std::string> materials = {};  ///< two names, of which one may be that of a part
    std::optional<double> friction = {};      ///< coefficient
    std::optional<double> restitution = {};   ///< coefficient
};

/// The name of the first material, which the section [grains] describes.
inline constexpr char const* first_material = "grains";

/// One material of a layer with everything that holds for it.
struct Material {
    std::string name;           ///< `first_material` for the first
    Grains grains;              ///< sizes, density, friction and restitution on itself
    double trough_friction;     ///< coefficient on the trough
    double trough_restitution;  ///< coefficient on the trough
    double number_fraction;     ///< of all grains; the fractions of all materials sum to 1
};

/// The materials of a layer, the one of [grains] first.
std::vector<Material> materials(Scenario const& scenario);

/// Friction and restitution of a contact.
struct ContactCoefficients {
    double friction;     ///< coefficient of friction
    double restitution;  ///< coefficient of restitution
};

/// 2 / (1 / a + 1 / b): exactly a when both are equal, and 0 when one of them is 0.
double harmonic_mean(double a, double b);

/// The contact of grains of two materials, which may be the same. A coefficient for which the campaign file
/// gives no pair is the harmonic mean of those of the materials on themselves, as MercuryDPM takes it for
/// mixed species (Weinhart et al., Computer Physics Communications 249, 2020, 107129;
/// BaseSpecies::average).
ContactCoefficients contact_of(Scenario const& scenario, Material const& one, Material const& other);

/// The parts of the trough's mesh that pairs name, in the order of the mesh: grains touch them otherwise than
/// the trough. A name that is also that of a material means the material.
std::vector<std::string> own_parts(Scenario const& scenario);

/// The contact of a material with a part of the trough's mesh. A coefficient for which the campaign file
/// gives no pair is that of the material on the trough.
ContactCoefficients contact_with_trough(Scenario const& scenario, Material const& material,
                                        std::string_view part);

/// Grains of one size and material.
struct MixtureClass {
    double diameter;         ///< m
    double number_fraction;  ///< of all grains; the fractions of all classes sum to 1
    int material;            ///< index in materials()
};

/// The size classes of all materials, largest first.
std::vector<MixtureClass> size_classes(Scenario const& scenario);

double largest_diameter(Scenario const& scenario);   ///< Diameter of the largest size class, m.
double smallest_diameter(Scenario const& scenario);  ///< Diameter of the smallest size class, m.
double mean_grain_volume(Scenario const& scenario);  ///< Mean by number of the volumes of the grains, m^3.

/// Mean of the materials' diameters, weighted with their volumes, m: the length in which depths and boxes
/// are expressed. That of [grains] when there is no other material.
double mean_diameter(Scenario const& scenario);

/// Mass of the grains divided by their volume, kg/m^3.
double mean_density(Scenario const& scenario);

/// Mean of the materials' friction on the trough, weighted with their masses: what the theory of a point
/// mass takes, because in a layer that is well mixed the materials carry the normal force in this proportion.
/// Parts of a mesh with a friction of their own are weighted with their area in plan.
double mean_trough_friction(Scenario const& scenario);

/// Mean of the materials' restitution on the trough, weighted in the same way.
double mean_trough_restitution(Scenario const& scenario);

}  // namespace vibrotrough::scenario
