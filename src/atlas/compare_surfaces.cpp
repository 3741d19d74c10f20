/// What the atlas would be with another trend, and without one of its inputs, for validation/atlas: fits each
/// surface to the layers of the atlas and compares it with the random layers, which no surface has seen.
/// Prints a table as CSV.
///
/// usage: compare_surfaces LAYERS.csv HELD_OUT.csv

#include "atlas/tables.hpp"
#include "core/atomic_file.hpp"

#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace {

using namespace vibrotrough;

/// A table of layers with the model of each as the trend of a surface.
struct Layers {
    std::vector<atlas::SurfacePoint> points;
    double numerical_error;  ///< 95 %, in velocity efficiency
};

Layers read(char const* file, atlas::LayerModel model) {
    std::string const text = core::read_given_file(file);
    return {atlas::read_layers(text, file, model), atlas::read_numerical_error(text, file)};
}

/// Takes an input away from all points.
void drop(std::vector<atlas::SurfacePoint>& points, std::size_t input) {
    for (auto& point : points) point.place.erase(point.place.begin() + static_cast<std::ptrdiff_t>(input));
}

/// Fits a surface to `known` and prints how well it predicts itself, each layer from all others, and
/// `unseen`.
void compare(std::string const& name, std::vector<atlas::SurfaceInput> const& inputs, Layers const& known,
             Layers const& unseen, atlas::Trend trend) {
    atlas::Surface const surface(inputs, known.points, {.trend = trend});
    double const sure = std::hypot(atlas::scatter_half_width(surface), known.numerical_error);
    double squares = 0;
    int held = 0;
    for (auto const& layer : unseen.points) {
        auto const [efficiency, half_width] = surface.at(layer.place, layer.theory);
        double const error = layer.efficiency - efficiency;
        squares += error * error;
        held += std::abs(error) <= std::hypot(half_width, sure, layer.half_width) ? 1 : 0;
    }
    auto const count = unseen.points.size();
    auto const quality = surface.quality();
    fmt::print("{},{:.4f},{},{},{},{:.4f}\n", name, quality.q2, quality.points, count, held,
               std::sqrt(squares / static_cast<double>(count)));
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    using atlas::LayerModel;
    try {
        if (argc != 3) throw std::runtime_error("usage: compare_surfaces LAYERS.csv HELD_OUT.csv");
        auto const both = [&](LayerModel model) {
            return std::pair(read(argv[1], model), read(argv[2], model));
        };
        auto const [known, unseen] = both(LayerModel::atlas);
        auto const [by_law, unseen_by_law] = both(LayerModel::rolling_layer);
        auto const [by_theory, unseen_by_theory] = both(LayerModel::point_mass);
        fmt::print("surface,q2,layers,random_layers,held,rms\n");
        compare("of the atlas", atlas::inputs(), known, unseen, atlas::Trend::theory);
        compare("trend: law alone", atlas::inputs(), by_law, unseen_by_law, atlas::Trend::theory);
        compare("trend: point mass", atlas::inputs(), by_theory, unseen_by_theory, atlas::Trend::theory);
        compare("trend: none", atlas::inputs(), known, unseen, atlas::Trend::constant);
        for (std::size_t k = 0; k < atlas::inputs().size(); ++k) {
            auto inputs = atlas::inputs();
            auto some = known, others = unseen;
            std::string const name = "without " + inputs[k].key;
            inputs.erase(inputs.begin() + static_cast<std::ptrdiff_t>(k));
            drop(some.points, k);
            drop(others.points, k);
            compare(name, inputs, some, others, atlas::Trend::theory);
        }
    } catch (std::exception const& error) {
        fmt::print(stderr, "compare_surfaces: {}\n", error.what());
        return 1;
    }
}
