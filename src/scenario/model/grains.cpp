#include "scenario/model/grains.hpp"

#include "core/csv.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include <boost/math/distributions/normal.hpp>
#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

constexpr int continuous_classes = 10;
constexpr double lognormal_cut = 2.5;  // standard deviations
constexpr std::size_t most_spheres_of_clump = 1000;
constexpr double largest_proportion = 1000;  ///< of a clump to its smallest radius

double cube(double value) {
    return value * value * value;
}

std::vector<SizeClass> three_classes(Grains const& grains) {
    double const d = grains.diameter, s = grains.diameter_spread;
    return {{d * (1 + s), 1.0 / 3}, {d, 1.0 / 3}, {d * (1 - s), 1.0 / 3}};
}

/// The mean of d^3 over diameters that are equally frequent between a and b is (b^4 - a^4) / (4 (b - a)).
std::vector<SizeClass> uniform_classes(Grains const& grains) {
    std::vector<SizeClass> classes;
    double const least = grains.diameter * (1 - grains.diameter_spread);
    double const width = 2 * grains.diameter * grains.diameter_spread / continuous_classes;
    for (int i = continuous_classes; i-- > 0;) {
        double const a = least + width * i, b = a + width;
        classes.push_back({std::cbrt((a + b) * (a * a + b * b) / 4), 1.0 / continuous_classes});
    }
    return classes;
}

/// With d = m exp(s z), z normal: E[d^3; a < z < b] = m^3 exp(9 s^2 / 2) (Phi(b - 3 s) - Phi(a - 3 s)).
std::vector<SizeClass> lognormal_classes(Grains const& grains) {
    boost::math::normal const normal;
    double const s = grains.diameter_spread;
    double const tail = cdf(normal, -lognormal_cut), inside = 1 - 2 * tail;
    std::vector<SizeClass> classes;
    for (int i = continuous_classes; i-- > 0;) {
        double const a = quantile(normal, tail + inside * i / continuous_classes);
        double const b = quantile(normal, tail + inside * (i + 1) / continuous_classes);
        double const volume = std::exp(4.5 * s * s) * (cdf(normal, b - 3 * s) - cdf(normal, a - 3 * s)) *
                              continuous_classes / inside;
        classes.push_back({grains.diameter * std::cbrt(volume), 1.0 / continuous_classes});
    }
    return classes;
}

std::vector<SizeClass> listed_classes(Grains const& grains) {
    std::vector<SizeClass> classes;
    for (std::size_t i = 0; i < grains.diameters.size(); ++i) {
        double const d = grains.diameters[i];
        classes.push_back({d, grains.number_fractions.empty() ? grains.mass_fractions[i] / cube(d)
                                                              : grains.number_fractions[i]});
    }
    double const sum =
        std::accumulate(classes.begin(), classes.end(), 0.0,
                        [](double so_far, auto const& size) { return so_far + size.number_fraction; });
    for (SizeClass& size : classes) size.number_fraction /= sum;
    std::ranges::sort(classes, std::greater(), &SizeClass::diameter);
    return classes;
}

/// Corner spheres of a cube with edge 1: a rounded cube.
std::vector<Sphere> cube_spheres() {
    constexpr double radius = 0.3, centre = 0.5 - radius;
    std::vector<Sphere> spheres;
    for (int const i : {-1, 1}) {
        for (int const j : {-1, 1}) {
            for (int const k : {-1, 1}) spheres.push_back({i * centre, j * centre, k * centre, radius});
        }
    }
    return spheres;
}

/// Three spheres in a row that overlap: a rod twice as long as thick.
std::vector<Sphere> rod_spheres() {
    return {{-0.5, 0, 0, 0.5}, {0, 0, 0, 0.5}, {0.5, 0, 0, 0.5}};
}

/// A shape is only its proportions, so that numbers which differ by more are mistakes. Their third powers,
/// which its moments need, would be lost in rounding or would overflow.
void check_proportions(std::vector<Sphere> const& spheres) {
    double const smallest = std::ranges::min(spheres, {}, &Sphere::radius).radius;
    for (Sphere const& s : spheres) {
        double const reach = std::max({std::abs(s.x), std::abs(s.y), std::abs(s.z), s.radius});
        if (!(reach <= largest_proportion * smallest) || !(smallest > 1e-30) || !(reach < 1e30)) {
            throw std::invalid_argument(fmt::format(
                "a sphere reaches {:.3g} from the origin, more than {:.0f} times the smallest radius, "
                "which is {:.3g}",
                reach, largest_proportion, smallest));
        }
    }
}

std::vector<Sphere> read_spheres(std::string_view text) {
    std::vector<Sphere> spheres;
    for (auto const& [values, line] : core::read_number_table(text, {"x", "y", "z", "radius"})) {
        if (!(values[3] > 0))
            throw std::invalid_argument(fmt::format("line {}: the radius is not above 0", line));
        spheres.push_back({values[0], values[1], values[2], values[3]});
    }
    if (spheres.size() > most_spheres_of_clump)
        throw std::invalid_argument(fmt::format("there are more than {} spheres", most_spheres_of_clump));
    if (spheres.empty()) throw std::invalid_argument("there are no spheres");
    check_proportions(spheres);
    return spheres;
}

}  // namespace

std::string_view name_of(Rotation rotation) {
    constexpr std::array<std::string_view, 3> names{"free", "rolling", "blocked"};
    return names.at(static_cast<std::size_t>(rotation));
}

std::string_view name_of(SizeLaw law) {
    constexpr std::array<std::string_view, 4> names{"three-classes", "uniform", "lognormal", "listed"};
    return names.at(static_cast<std::size_t>(law));
}

std::vector<SizeClass> size_classes(Grains const& grains) {
    if (grains.size_law == SizeLaw::listed) return listed_classes(grains);
    if (grains.diameter_spread == 0) return {{grains.diameter, 1}};
    switch (grains.size_law) {
        case SizeLaw::uniform:
            return uniform_classes(grains);
        case SizeLaw::lognormal:
            return lognormal_classes(grains);
        default:
            return three_classes(grains);
    }
}

double largest_diameter(Grains const& grains) {
    return size_classes(grains).front().diameter;
}

double smallest_diameter(Grains const& grains) {
    return size_classes(grains).back().diameter;
}

double mean_grain_volume(Grains const& grains) {
    double volume = 0;
    for (SizeClass const& size : size_classes(grains)) {
        volume += size.number_fraction * std::numbers::pi / 6 * cube(size.diameter);
    }
    return volume;
}

bool is_clump(Grains const& grains) {
    return grains.shape != "sphere";
}

std::shared_ptr<ShapeFile const> read_shape(NamedFile file) {
    std::vector<Sphere> spheres = read_spheres(file.content);
    return std::make_shared<ShapeFile const>(ShapeFile{std::move(file), std::move(spheres)});
}

std::vector<Sphere> const& shape_spheres(Grains const& grains) {
    static std::vector<Sphere> const sphere{{0, 0, 0, 0.5}}, cube = cube_spheres(), rod = rod_spheres();
    if (grains.shape == "cube") return cube;
    if (grains.shape == "rod") return rod;
    return grains.shape_file ? grains.shape_file->spheres : sphere;
}

}  // namespace vibrotrough::scenario
