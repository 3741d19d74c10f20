/// Finds the surface of the atlas from its table of layers, for validation/atlas: prints the draws of its
/// hyperparameters as CSV, and how well it predicts the layers, each from all others, on standard error.
///
/// usage: fit_atlas LAYERS.csv

#include "atlas/tables.hpp"
#include "core/atomic_file.hpp"

#include <cstdio>
#include <exception>

#include <fmt/format.h>

int main(int argc, char** argv) {
    using namespace vibrotrough;
    try {
        if (argc != 2) throw std::runtime_error("usage: fit_atlas LAYERS.csv");
        auto const points = atlas::read_layers(core::read_given_file(argv[1]), argv[1]);
        atlas::Surface const surface(atlas::inputs(), points);
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
