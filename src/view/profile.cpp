#include "view/profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace vibrotrough::view {
namespace {

constexpr std::size_t most_slabs = 400;

/// The volume of a sphere below height u above its centre: pi (r^2 u - u^3 / 3) + 2/3 pi r^3.
double volume_below(double u, double r) {
    double const h = std::clamp(u, -r, r);
    return std::numbers::pi * (r * r * h - h * h * h / 3.0 + 2.0 / 3.0 * r * r * r);
}

}  // namespace

Profile profile_of(GrainFrame const& frame, std::vector<float> const& velocity, double surface, double area) {
    if (frame.grains() == 0) return {};
    double top = 0.0;
    for (std::size_t i = 0; i < frame.grains(); ++i) {
        top = std::max<double>(top, frame.position[3 * i + 2] + frame.radius[i] - surface);
    }
    double const radii = std::accumulate(frame.radius.begin(), frame.radius.end(), 0.0);
    double const thickness = std::max(radii / static_cast<double>(frame.grains()), top / most_slabs);
    auto const slabs = std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(top / thickness)));
    std::vector<double> volume(slabs, 0.0), flow(slabs, 0.0);
    for (std::size_t i = 0; i < frame.grains(); ++i) {
        double const r = frame.radius[i], centre = frame.position[3 * i + 2] - surface;
        auto const slab_at = [&](double height) {
            return static_cast<std::size_t>(
                std::clamp(std::floor(height / thickness), 0.0, static_cast<double>(slabs - 1)));
        };
        double below = 0.0;
        std::size_t const last = slab_at(centre + r);
        for (std::size_t slab = slab_at(centre - r); slab <= last; ++slab) {
            double const upper = static_cast<double>(slab + 1) * thickness - centre;
            double const to_here = slab == last ? volume_below(r, r) : volume_below(upper, r);
            volume[slab] += to_here - below;
            flow[slab] += (to_here - below) * velocity[3 * i];
            below = to_here;
        }
    }
    Profile profile;
    for (std::size_t slab = 0; slab < slabs; ++slab) {
        profile.height.push_back((static_cast<double>(slab) + 0.5) * thickness);
        profile.solid_fraction.push_back(volume[slab] / (area * thickness));
        profile.velocity.push_back(volume[slab] > 0.0 ? flow[slab] / volume[slab]
                                                      : std::numeric_limits<double>::quiet_NaN());
    }
    return profile;
}

}  // namespace vibrotrough::view
