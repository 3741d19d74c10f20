#include "view/colour_scales.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace vibrotrough::view {
namespace {

constexpr double counted_share = 0.95;

}  // namespace

double rounded_up(double value) {
    if (!(value > 0.0) || !std::isfinite(value)) return 0.0;
    double const power = std::pow(10.0, std::floor(std::log10(value)));
    for (double const digit : {1.0, 2.0, 5.0}) {
        if (value <= digit * power * (1.0 + 1e-9)) return digit * power;
    }
    return 10.0 * power;
}

void ColourScales::Mean::add(std::vector<float> const& values) {
    if (values.empty()) return;
    std::vector<float> sizes(values.size());
    std::ranges::transform(values, sizes.begin(), [](float value) { return std::abs(value); });
    auto const place = static_cast<std::ptrdiff_t>(counted_share * static_cast<double>(sizes.size() - 1));
    std::ranges::nth_element(sizes, sizes.begin() + place);
    sum += sizes[static_cast<std::size_t>(place)];
    ++frames;
}

double ColourScales::Mean::rounded() const {
    return frames == 0 ? 0.0 : rounded_up(sum / frames);
}

void ColourScales::add(std::vector<float> const& velocity, std::vector<float> const& spin,
                       std::vector<float> const& height) {
    velocity_.add(velocity);
    spin_.add(spin);
    height_.add(height);
}

double ColourScales::velocity() const {
    return velocity_.rounded();
}

double ColourScales::spin() const {
    return spin_.rounded();
}

double ColourScales::height() const {
    return height_.rounded();
}

}  // namespace vibrotrough::view
