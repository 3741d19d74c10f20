/// Finds the surface of the atlas from its table of layers, for validation/atlas: prints the draws of its
/// hyperparameters as CSV, and how well it predicts the layers, each from all others, on standard error.
///
/// usage: fit_atlas LAYERS.csv [OF], where OF is added_mass or damping instead of the efficiency, or law for
/// the error of the law over the inputs alone

#include "atlas/tables.hpp"
#include "core/atomic_file.hpp"

#include <cstdio>
#include <exception>

#include <fmt/format.h>

int main(int argc, char** argv) {
    using namespace vibrotrough;
    try {
        if (argc != 2 && argc != 3) throw std::runtime_error("usage: fit_atlas LAYERS.csv [OF]");
        std::string const text = core::read_given_file(argv[1]);
        std::string const of = argc == 3 ? argv[2] : "";
        bool const is_efficiency = of.empty() || of == "law";
        auto const& inputs = of.empty() ? atlas::surface_inputs() : atlas::inputs();
        auto points =
            is_efficiency ? atlas::read_layers(text, argv[1]) : atlas::read_column(text, argv[1], of);
        if (of.empty()) points = atlas::with_trends(points);
        // `learn` takes the lengths of the law's error for those of other layers, and is tested with usual
        // ones.
        auto const prior = of == "law" ? atlas::SurfacePrior{} : atlas::prior_of_atlas(inputs);
        atlas::Surface const surface(inputs, points, prior);
        int number = 0;
        // Every third is enough for many layers, and each costs time in every prediction.
        std::vector<inference::Hyperparameters> few;
        for (auto const& draw : surface.draws()) {
            if (number++ % 3 == 0) few.push_back(draw);
        }
        fmt::print("{}", atlas::draws_csv(few, inputs));
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
