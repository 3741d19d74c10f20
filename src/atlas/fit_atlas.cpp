/// Finds the surface of the atlas from its table of layers, for validation/atlas: prints the draws of its
/// hyperparameters as CSV, and how well it predicts the layers, each from all others, on standard error.
///
/// usage: fit_atlas LAYERS.csv [COLUMN], where COLUMN is added_mass or damping instead of the efficiency

#include "atlas/tables.hpp"
#include "core/atomic_file.hpp"

#include <cstdio>
#include <exception>

#include <fmt/format.h>

int main(int argc, char** argv) {
    using namespace vibrotrough;
    try {
        if (argc != 2 && argc != 3) throw std::runtime_error("usage: fit_atlas LAYERS.csv [COLUMN]");
        std::string const text = core::read_given_file(argv[1]);
        auto const points =
            argc == 2 ? atlas::read_layers(text, argv[1]) : atlas::read_column(text, argv[1], argv[2]);
        // What a layer does to its trough hardly depends on some of the inputs.
        atlas::SurfacePrior prior;
        if (argc == 3) prior.longest.assign(atlas::inputs().size(), 50);
        atlas::Surface const surface(atlas::inputs(), points, prior);
        int number = 0;
        // Every third is enough for many layers, and each costs time in every prediction.
        std::vector<inference::Hyperparameters> few;
        for (auto const& draw : surface.draws()) {
            if (number++ % 3 == 0) few.push_back(draw);
        }
        fmt::print("{}", atlas::draws_csv(few));
        atlas::SurfaceQuality const& q = surface.quality();
        fmt::print(stderr,
                   "{} layers, Q2 {:.3f}, {} within their intervals ({} to {} expected), extra noise {:.3f} "
                   "(p = {:.2g})\n",
                   q.points, q.q2, q.covered, q.least_covered, q.most_covered, q.extra_noise,
                   q.extra_noise_p);
        for (auto const& doubt : surface.doubts()) fmt::print(stderr, "{}\n", doubt);
    } catch (std::exception const& error) {
        fmt::print(stderr, "fit_atlas: {}\n", error.what());
        return 1;
    }
}
