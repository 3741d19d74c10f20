#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::scenario {

/// A file that a campaign names. It is in the folder of the campaign file, and a copy is kept in the folder
/// of each campaign that was planned.
struct NamedFile {
    std::string name;     ///< without folders
    std::string content;  ///< all bytes
};

/// How grains may rotate.
enum class Rotation {
    free,     ///< without resistance
    rolling,  ///< against a rolling friction (model epsd2)
    blocked,  ///< not at all
};

/// How diameters are distributed.
enum class SizeLaw {
    three_classes,  ///< 1 - s, 1 and 1 + s times the diameter, in equal numbers
    uniform,    ///< every diameter between 1 - s and 1 + s times the diameter is equally frequent, by number
    lognormal,  ///< ln(d) is normal by number, with the diameter as median and the standard deviation s
    listed,     ///< a list of diameters and their fractions
};

/// One sphere of a clump.
struct Sphere {
    double x, y, z;  ///< its centre
    double radius;   ///< in the unit of the centre
};

/// The shape of a clump as read from a file. Cases that name the same file share it.
struct ShapeFile {
    NamedFile file;               ///< name and text
    std::vector<Sphere> spheres;  ///< in any unit of length: the clump is scaled to its volume later
};

/// Reads the spheres of a shape: a CSV text with the header "x,y,z,radius", 1 to 1000 rows, radii above 0.
/// @throws std::invalid_argument with one line that describes what is wrong with the text
std::shared_ptr<ShapeFile const> read_shape(NamedFile file);

/// The grains of a layer: size, shape and material.
struct Grains {
    double diameter;         ///< m; of a clump, of the sphere with the clump's volume; of a list, its mean
    double diameter_spread;  ///< s, width of the size law
    double density;          ///< kg/m^3, of the material
    std::optional<double> youngs_modulus;  ///< Pa, of grain and trough; none: choose_modulus() (softness.hpp)
    bool is_modulus_chosen = false;        ///< whether choose_modulus() gave it
    double poisson_ratio;                  ///< of grain and trough
    double friction;                       ///< coefficient of grain on grain
    double restitution;                    ///< coefficient of grain on grain
    double rolling_friction;               ///< coefficient of the epsd2 model
    Rotation rotation = Rotation::free;    ///< how grains may rotate
    SizeLaw size_law = SizeLaw::three_classes;  ///< how diameters are distributed
    std::vector<double> diameters = {};         ///< m, of a list
    std::vector<double> number_fractions = {};  ///< of a list; empty if it has mass fractions
    std::vector<double> mass_fractions = {};    ///< of a list; empty if it has number fractions
    std::string shape = "sphere";               ///< "sphere", "cube", "rod", or the name of `shape_file`
    std::shared_ptr<ShapeFile const> shape_file = nullptr;  ///< of a shape that is not built in
    bool is_bulk_given = false;                             ///< the density follows from that of the layer
};

/// The word of the campaign file, such as "free".
std::string_view name_of(Rotation rotation);

/// The word of the campaign file, such as "three-classes"; "listed" for a list of diameters, which has no
/// word.
std::string_view name_of(SizeLaw law);

/// Grains of one size.
struct SizeClass {
    double diameter;         ///< m
    double number_fraction;  ///< of all grains; the fractions of all classes sum to 1
};

/// The size classes, largest first. A continuous law is divided into ten classes with equal numbers of
/// grains. Each has the diameter of its mean volume, so that the mass of the layer is exactly that of the
/// law. The log-normal law is cut off at 2.5 standard deviations.
std::vector<SizeClass> size_classes(Grains const& grains);

double largest_diameter(Grains const& grains);   ///< Diameter of the largest size class, m.
double smallest_diameter(Grains const& grains);  ///< Diameter of the smallest size class, m.
double mean_grain_volume(Grains const& grains);  ///< Mean by number of the volumes of the grains, m^3.

/// Whether a grain is a rigid body of several spheres.
bool is_clump(Grains const& grains);

/// The spheres of the grains' shape, built in or from its file, in any unit of length. The reference is valid
/// as long as the shape file.
std::vector<Sphere> const& shape_spheres(Grains const& grains);

}  // namespace vibrotrough::scenario
