#include "prepare/clump.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <numbers>
#include <utility>

namespace vibrotrough::prepare {
namespace {

constexpr int lines = 400;  // of integration, along y and along z

/// Integrals over the volume that the spheres cover.
struct Moments {
    double one = 0;                                         // volume
    double x = 0, y = 0, z = 0;                             // first
    double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;  // second
};

using Intervals = std::vector<std::pair<double, double>>;

/// The intervals of x in which the line (y, z) is inside at least one sphere, without overlaps.
void cut(std::vector<scenario::Sphere> const& spheres, double y, double z, Intervals& intervals) {
    intervals.clear();
    for (scenario::Sphere const& s : spheres) {
        double const square = s.radius * s.radius - (y - s.y) * (y - s.y) - (z - s.z) * (z - s.z);
        if (square > 0) intervals.emplace_back(s.x - std::sqrt(square), s.x + std::sqrt(square));
    }
    std::ranges::sort(intervals);
    std::size_t kept = 0;
    for (std::size_t i = 1; i < intervals.size(); ++i) {
        if (intervals[i].first <= intervals[kept].second) {
            intervals[kept].second = std::max(intervals[kept].second, intervals[i].second);
        } else {
            intervals[++kept] = intervals[i];
        }
    }
    if (!intervals.empty()) intervals.resize(kept + 1);
}

void add(Moments& m, std::pair<double, double> const& interval, double y, double z, double area) {
    auto const [a, b] = interval;
    double const length = area * (b - a), first = area * (b * b - a * a) / 2;
    m.one += length;
    m.x += first;
    m.y += y * length;
    m.z += z * length;
    m.xx += area * (b * b * b - a * a * a) / 3;
    m.yy += y * y * length;
    m.zz += z * z * length;
    m.xy += y * first;
    m.xz += z * first;
    m.yz += y * z * length;
}

Moments integrate(std::vector<scenario::Sphere> const& spheres) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double low_y = infinity, high_y = -infinity, low_z = infinity, high_z = -infinity;
    for (scenario::Sphere const& s : spheres) {
        low_y = std::min(low_y, s.y - s.radius), high_y = std::max(high_y, s.y + s.radius);
        low_z = std::min(low_z, s.z - s.radius), high_z = std::max(high_z, s.z + s.radius);
    }
    double const dy = (high_y - low_y) / lines, dz = (high_z - low_z) / lines;
    Moments moments;
    Intervals intervals;
    for (int i = 0; i < lines; ++i) {
        for (int j = 0; j < lines; ++j) {
            double const y = low_y + (i + 0.5) * dy, z = low_z + (j + 0.5) * dz;
            cut(spheres, y, z, intervals);
            for (auto const& interval : intervals) add(moments, interval, y, z, dy * dz);
        }
    }
    return moments;
}

Clump scaled_clump(std::vector<scenario::Sphere> spheres, Moments const& m, double volume) {
    double const scale = std::cbrt(volume / m.one), fifth = std::pow(scale, 5);
    double const x = m.x / m.one, y = m.y / m.one, z = m.z / m.one;
    double const xx = m.xx - m.one * x * x, yy = m.yy - m.one * y * y, zz = m.zz - m.one * z * z;
    Clump clump{{},
                volume,
                {fifth * (yy + zz), -fifth * (m.xy - m.one * x * y), -fifth * (m.xz - m.one * x * z),
                 fifth * (xx + zz), -fifth * (m.yz - m.one * y * z), fifth * (xx + yy)},
                0,
                std::numeric_limits<double>::infinity()};
    // Products of inertia that are zero by symmetry differ from zero by rounding. The engine would use them.
    for (std::size_t const product : {1U, 2U, 4U}) {
        if (std::abs(clump.inertia[product]) < 1e-9 * clump.inertia[0]) clump.inertia[product] = 0;
    }
    for (scenario::Sphere& s : spheres) {
        s = {(s.x - x) * scale, (s.y - y) * scale, (s.z - z) * scale, s.radius * scale};
        clump.bounding_radius = std::max(clump.bounding_radius, std::hypot(s.x, s.y, s.z) + s.radius);
        clump.smallest_radius = std::min(clump.smallest_radius, s.radius);
    }
    clump.spheres = std::move(spheres);
    return clump;
}

/// Integrating a shape costs some ten milliseconds: the cases of a campaign share its integrals.
Moments moments_of(std::vector<scenario::Sphere> const& spheres) {
    static std::mutex mutex;
    static std::map<std::vector<double>, Moments> known;
    std::vector<double> key;
    for (scenario::Sphere const& s : spheres) key.insert(key.end(), {s.x, s.y, s.z, s.radius});
    std::lock_guard const lock(mutex);
    auto const [found, is_new] = known.try_emplace(std::move(key));
    if (is_new) found->second = integrate(spheres);
    return found->second;
}

}  // namespace

std::shared_ptr<Clump const> make_clump(scenario::Grains const& grains) {
    std::vector<scenario::Sphere> const& spheres = shape_spheres(grains);
    double const volume = std::numbers::pi / 6 * std::pow(grains.diameter, 3);
    return std::make_shared<Clump const>(scaled_clump(spheres, moments_of(spheres), volume));
}

std::shared_ptr<Clump const> make_plate(double diameter) {
    std::vector<scenario::Sphere> spheres;
    for (int i = -1; i <= 1; ++i) {
        for (int j = -1; j <= 1; ++j)
            spheres.push_back({2 * i * diameter, 2 * j * diameter, 0, diameter / 2});
    }
    double const volume = 9 * std::numbers::pi / 6 * std::pow(diameter, 3);
    return std::make_shared<Clump const>(scaled_clump(spheres, moments_of(spheres), volume));
}

}  // namespace vibrotrough::prepare
