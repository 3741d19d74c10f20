/// What the atlas would be with another trend, and without one of its inputs, for validation/atlas: fits each
/// surface to the layers of the atlas and compares it with the random layers inside of its ranges, which no
/// surface has seen. Prints a table as CSV.
///
/// usage: compare_surfaces LAYERS.csv HELD_OUT.csv

#include "atlas/tables.hpp"
#include "atlas/value.hpp"
#include "core/atomic_file.hpp"

#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace {

using namespace vibrotrough;

using Layers = std::vector<atlas::SurfacePoint>;

Layers read(char const* file, atlas::LayerModel model) {
    return atlas::read_layers(core::read_given_file(file), file, model);
}

/// Takes an input away from all points.
void drop(Layers& points, std::size_t input) {
    for (auto& point : points) point.place.erase(point.place.begin() + static_cast<std::ptrdiff_t>(input));
}

/// Fits a surface to `known` and prints how well it predicts itself, each layer from all others, and
/// `unseen`.
void compare(std::string const& name, std::vector<atlas::SurfaceInput> const& inputs, Layers const& known,
             Layers const& unseen, atlas::Trend trend) {
    atlas::SurfacePrior prior = atlas::prior_of_atlas(inputs);
    prior.trend = trend;
    atlas::Surface const surface(inputs, known, prior);
    double squares = 0;
    for (auto const& layer : unseen)
        squares += std::pow(layer.efficiency - surface.efficiency_at(layer.place, layer.theory), 2);
    auto const count = unseen.size();
    auto const quality = surface.quality();
    fmt::print("{},{:.4f},{},{},{:.4f}\n", name, quality.q2, quality.points, count,
               std::sqrt(squares / static_cast<double>(count)));
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    using atlas::LayerModel;
    try {
        if (argc != 3) throw std::runtime_error("usage: compare_surfaces LAYERS.csv HELD_OUT.csv");
        auto const both = [&](LayerModel model) {
            auto unseen = read(argv[2], model);
            std::erase_if(unseen, [](auto const& one) { return !atlas::outside_ranges(one.place).empty(); });
            return std::pair(read(argv[1], model), unseen);
        };
        auto const [known, unseen] = both(LayerModel::atlas);
        auto const [by_law, unseen_by_law] = both(LayerModel::rolling_layer);
        auto const [by_theory, unseen_by_theory] = both(LayerModel::point_mass);
        fmt::print("surface,q2,layers,random_layers,rms\n");
        Layers const known_too = atlas::with_trends(known), unseen_too = atlas::with_trends(unseen);
        compare("of the atlas", atlas::surface_inputs(), known_too, unseen_too, atlas::Trend::theory);
        compare("law as trend alone", atlas::inputs(), known, unseen, atlas::Trend::theory);
        compare("law as input alone", atlas::surface_inputs(), known_too, unseen_too, atlas::Trend::constant);
        compare("trend: law alone", atlas::inputs(), by_law, unseen_by_law, atlas::Trend::theory);
        compare("trend: point mass", atlas::inputs(), by_theory, unseen_by_theory, atlas::Trend::theory);
        compare("trend: none", atlas::inputs(), known, unseen, atlas::Trend::constant);
        for (std::size_t k = 0; k < atlas::inputs().size(); ++k) {
            auto inputs = atlas::surface_inputs();
            auto some = known_too, others = unseen_too;
            std::string const name = "without " + inputs[k].key;
            inputs.erase(inputs.begin() + static_cast<std::ptrdiff_t>(k));
            drop(some, k);
            drop(others, k);
            compare(name, inputs, some, others, atlas::Trend::theory);
        }
    } catch (std::exception const& error) {
        fmt::print(stderr, "compare_surfaces: {}\n", error.what());
        return 1;
    }
}
