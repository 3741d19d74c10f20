#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::scenario {

/// A file that a campaign names. It lies beside the campaign file, and a copy beside each frozen one.
struct NamedFile {
    std::string name;  ///< plain, without folders
    std::string content;
};

enum class Rotation {
    free,     ///< grains roll as they like
    rolling,  ///< a rolling friction resists (model epsd2)
    blocked,  ///< grains do not rotate
};

/// How diameters are distributed.
enum class SizeLaw {
    three_classes,  ///< 1 - s, 1 and 1 + s times the diameter, in equal numbers
    uniform,        ///< every diameter between 1 - s and 1 + s times the diameter is as frequent, by number
    lognormal,      ///< ln(d) is normal by number: median the diameter, standard deviation s
    listed,         ///< diameters and their fractions
};

struct Sphere {
    double x, y, z, radius;
};

/// The shape of a clump as read from a file. Cases that name the same file share it.
struct ShapeFile {
    NamedFile file;
    std::vector<Sphere> spheres;  ///< in any unit of length: the clump is scaled to its volume later
};

/// Reads the spheres of a shape: a CSV text with the header "x,y,z,radius", 1 to 1000 rows, radii above 0.
/// @throws std::invalid_argument with one line that says what is wrong with the text
std::shared_ptr<ShapeFile const> read_shape(NamedFile file);

struct Grains {
    double diameter;         ///< m; of a clump, of the sphere with the clump's volume; of a list, its mean
    double diameter_spread;  ///< s
    double density;          ///< kg/m^3
    double youngs_modulus;   ///< Pa, of grain and trough
    double poisson_ratio;
    double friction;          ///< grain on grain
    double restitution;       ///< grain on grain, nominal
    double rolling_friction;  ///< coefficient of the epsd2 model
    Rotation rotation = Rotation::free;
    SizeLaw size_law = SizeLaw::three_classes;
    std::vector<double> diameters = {};         ///< m, of a list
    std::vector<double> number_fractions = {};  ///< of a list, or
    std::vector<double> mass_fractions = {};    ///< of a list
    std::string shape = "sphere";               ///< "sphere", "cube", "rod", or the name of `shape_file`
    std::shared_ptr<ShapeFile const> shape_file = nullptr;
};

/// The word of the campaign file: "free", "three-classes" ("listed" has none and is its own name).
std::string_view name_of(Rotation rotation);
std::string_view name_of(SizeLaw law);

struct SizeClass {
    double diameter;         ///< m
    double number_fraction;  ///< all sum to 1
};

/// The size classes, largest first. A continuous law is cut into ten classes of equal number, each with the
/// diameter of its mean volume, so that the mass is the law's; the log-normal law is cut off at 2.5 standard
/// deviations.
std::vector<SizeClass> size_classes(Grains const& grains);

double largest_diameter(Grains const& grains);   ///< m
double smallest_diameter(Grains const& grains);  ///< m
double mean_grain_volume(Grains const& grains);  ///< m^3, by number

/// Whether a grain is a rigid body of several spheres.
bool is_clump(Grains const& grains);

/// The spheres of the grains' shape, built in or from its file, in any unit of length.
std::vector<Sphere> const& shape_spheres(Grains const& grains);

}  // namespace vibrotrough::scenario
