#include "measure/impact_law.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>

namespace vibrotrough::measure {
namespace {

/// The accelerations of the impact in its own units.
struct Motion {
    double power, damping_power, damping;

    double acceleration(double overlap, double speed) const {
        double const d = std::max(overlap, 0.0);
        return -std::pow(d, power) - damping * std::pow(d, damping_power) * speed;
    }
};

/// One step of the classical method of Runge and Kutta.
void advance(Motion const& motion, double step, double& overlap, double& speed) {
    double const a1 = motion.acceleration(overlap, speed), v1 = speed, v2 = speed + step / 2 * a1,
                 a2 = motion.acceleration(overlap + step / 2 * v1, v2), v3 = speed + step / 2 * a2,
                 a3 = motion.acceleration(overlap + step / 2 * v2, v3), v4 = speed + step * a3,
                 a4 = motion.acceleration(overlap + step * v3, v4);
    overlap += step / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
    speed += step / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
}

}  // namespace

ImpactLaw::ImpactLaw(ContactForce force, double restitution)
    : power_(force == ContactForce::hertz ? 1.5 : 1) {
    double const loss = std::log(restitution), ratio = -loss / std::hypot(std::numbers::pi, loss);
    Motion const motion{power_, force == ContactForce::hertz ? 0.25 : 0.0,
                        ratio * (force == ContactForce::hertz ? std::sqrt(5.0) : 2.0)};
    // Impacts last 3 to 7 units; strongly damped ones creep apart.
    constexpr double longest = 20;
    double overlap = 0, speed = 1;
    table_.push_back(0);
    while (static_cast<double>(table_.size()) * time_step_ < longest) {
        advance(motion, time_step_, overlap, speed);
        if (!(overlap > 0)) break;
        table_.push_back(overlap);
    }
    largest_ = static_cast<std::size_t>(std::distance(table_.begin(), std::ranges::max_element(table_)));
}

double ImpactLaw::overlap_at(double time) const {
    double const place = time / time_step_;
    auto const before = static_cast<std::size_t>(place);
    if (before + 1 >= table_.size()) return 0;
    return std::lerp(table_[before], table_[before + 1], place - static_cast<double>(before));
}

double ImpactLaw::time_at(double overlap) const {
    auto const end = table_.begin() + static_cast<std::ptrdiff_t>(largest_) + 1;
    auto const after = std::lower_bound(table_.begin(), end, overlap);
    if (after == table_.begin()) return 0;
    if (after == end) return static_cast<double>(largest_) * time_step_;
    double const share = (overlap - *(after - 1)) / (*after - *(after - 1));
    return (static_cast<double>(after - 1 - table_.begin()) + share) * time_step_;
}

std::optional<double> ImpactLaw::energy(ImpactingPair const& pair, double first, double second,
                                        double between) const {
    if (!(second > first) || !(first > 0)) return {};
    auto const length = [&](double speed) {
        return std::pow(pair.mass * speed * speed / pair.stiffness, 1 / (power_ + 1));
    };
    // How much larger the second overlap is than that of an impact with this speed.
    auto const missing = [&](double speed) {
        double const unit = length(speed), time = time_at(first / unit) + between * speed / unit;
        return second - unit * overlap_at(time);
    };
    // The slowest impact that reaches the first overlap has it as its largest.
    double const slowest =
        std::sqrt(std::pow(first / table_[largest_], power_ + 1) * pair.stiffness / pair.mass);
    double slow = slowest, fast = std::max(slowest, (second - first) / between);
    constexpr int doublings = 60, halvings = 60;
    for (int i = 0; i < doublings && missing(fast) > 0; ++i) fast *= 2;
    for (int i = 0; i < halvings; ++i) {
        double const middle = (slow + fast) / 2;
        (missing(middle) > 0 ? slow : fast) = middle;
    }
    return pair.mass * fast * fast / 2;
}

double ImpactLaw::elastic_energy(ImpactingPair const& pair, double overlap) const {
    return pair.stiffness * std::pow(overlap, power_ + 1) / (power_ + 1);
}

}  // namespace vibrotrough::measure
