#include "theory/pushed_mass.hpp"

#include "theory/detail/phases.hpp"

#include <cmath>

namespace vibrotrough::theory {

std::optional<double> mean_slip(std::vector<PushedInterval> const& period, double duration) {
    using detail::Instant, detail::Tangent;
    double pull = 0, friction = 0, moved = 0;
    for (PushedInterval const& part : period) pull += part.needed, friction += part.friction;
    if (std::abs(pull) >= friction) return {};
    detail::Forces forces;
    detail::ContactLaw const law(forces);
    detail::Hints hints;
    auto const record = [&](PhaseKind, double, double, double, double distance, double) {
        moved += distance;
    };
    auto const map = [&](double v) {
        moved = 0;
        hints.restart();
        Tangent s{v, 1};
        for (PushedInterval const& part : period) {
            forces.set_constant(part.needed, part.friction);
            s = follow_contact(law, s, Instant{0, 0, 1}, Instant{duration, 0, 1}, false, hints, record);
        }
        return s;
    };
    detail::fixed_point(map, 0, 1e-13);
    return moved / (duration * static_cast<double>(period.size()));
}

}  // namespace vibrotrough::theory
