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

double deviation_within(theory::Range const& known, Uncertain const& number,
                        std::function<std::optional<double>(double)> const& value_at) {
    auto const middle = value_at(number.mean);
    return deviation_of(number, [&](double value) -> std::optional<double> {
        double last = std::clamp(value, known.low, known.high);
        // A mean at the end of the range has its slope on the other side.
        if (last == number.mean) last = std::clamp(2 * number.mean - value, known.low, known.high);
        if (value == last || value == number.mean || last == number.mean) return value_at(value);
        auto const there = value_at(last);
        if (!there || !middle) return {};
        return *middle + (*there - *middle) * (value - number.mean) / (last - number.mean);
    });
}

}  // namespace vibrotrough::learn
