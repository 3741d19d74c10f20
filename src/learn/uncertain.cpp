#include "learn/uncertain.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace vibrotrough::learn {

double Uncertain::low() const {
    return mean - std::numbers::sqrt3 * sd;
}

double Uncertain::high() const {
    return mean + std::numbers::sqrt3 * sd;
}

Uncertain between_ends(double low, double high) {
    if (!(low <= high)) throw std::invalid_argument("the ends of a range are in the wrong order");
    return {(low + high) / 2, (high - low) / (2 * std::numbers::sqrt3), Shape::uniform};
}

Uncertain unknown_rolling_friction() {
    return between_ends(0, 0.2);
}

std::array<UncertainNode, 3> nodes_of(Uncertain const& number) {
    bool const is_normal = number.shape == Shape::normal;
    double const outer = is_normal ? 1.0 / 6 : 5.0 / 18;
    // Of the three-point rules of Hermite and Legendre, in standard deviations.
    double const away = number.sd * (is_normal ? std::numbers::sqrt3 : std::sqrt(9.0 / 5));
    return {{{outer, number.mean - away}, {1 - 2 * outer, number.mean}, {outer, number.mean + away}}};
}

double deviation_of(Uncertain const& number, std::function<std::optional<double>(double)> const& value_at) {
    double known = 0, sum = 0, squares = 0;
    for (UncertainNode const& node : nodes_of(number)) {
        auto const value = value_at(node.value);
        if (!value) continue;
        known += node.share;
        sum += node.share * *value;
        squares += node.share * *value * *value;
    }
    if (known <= 0) return 0;
    return std::sqrt(std::max(0.0, squares / known - sum * sum / (known * known)));
}

}  // namespace vibrotrough::learn
