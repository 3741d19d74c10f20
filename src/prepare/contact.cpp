#include "prepare/contact.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace vibrotrough::prepare {
namespace {

double sphere_mass(scenario::Grains const& grains, double radius) {
    return grains.density * 4 * std::numbers::pi / 3 * std::pow(radius, 3);
}

/// 4/3 E* sqrt(R*), N/m^(3/2).
double hertz_stiffness(scenario::Grains const& grains, ContactPair const& pair) {
    return 4.0 / 3 * effective_modulus(grains) * std::sqrt(pair.radius);
}

/// The largest root of a x^(n + 1) = b x^n + c with a > 0 and b, c >= 0, which is unique: Newton's method
/// from above, where the function is convex.
double balance(double a, double b, double c, int n) {
    double x = b / a + std::pow(c / a, 1.0 / (n + 1));
    for (int i = 0; i < 100; ++i) {
        double const next =
            x - (std::pow(x, n) * (a * x - b) - c) / (std::pow(x, n - 1) * ((n + 1) * a * x - n * b));
        if (!(next < x * (1 - 1e-14))) break;
        x = next;
    }
    return x;
}

}  // namespace

ContactPair two_grains(scenario::Grains const& grains, double radius) {
    return {radius / 2, sphere_mass(grains, radius) / 2};
}

ContactPair grain_on_trough(scenario::Grains const& grains, double radius) {
    return {radius, sphere_mass(grains, radius)};
}

double effective_modulus(scenario::Grains const& grains) {
    return grains.youngs_modulus.value() / (2 * (1 - grains.poisson_ratio * grains.poisson_ratio));
}

double hooke_stiffness(scenario::Grains const& grains, ContactPair const& pair, double speed) {
    double const elastic = 16.0 / 15 * effective_modulus(grains) * std::sqrt(pair.radius);
    return elastic * std::pow(pair.mass * speed * speed / elastic, 0.2);
}

double damping_ratio(double restitution) {
    double const loss = std::log(restitution);
    return -loss / std::hypot(std::numbers::pi, loss);
}

LinearImpact linear_impact(double stiffness, double mass, double damping_ratio) {
    double const natural = std::sqrt(stiffness / mass);
    double const root = std::sqrt(1 - damping_ratio * damping_ratio);
    double const duration = 2 * std::acos(damping_ratio) / (natural * root);
    return {duration, std::exp(-damping_ratio * natural * duration)};
}

double attraction_per_overlap(double cohesion, ContactPair const& pair) {
    return 2 * std::numbers::pi * pair.radius * cohesion;
}

double pull_off_force(scenario::Grains const& grains, double cohesion, ContactPair const& pair) {
    double const modulus = effective_modulus(grains);
    return 2 * std::pow(std::numbers::pi * cohesion, 3) / 3 * std::pow(pair.radius / modulus, 2);
}

double overlap_under_force(scenario::Scenario const& s, ContactPair const& pair, double force, double speed) {
    double const attraction = attraction_per_overlap(s.engine.cohesion, pair);
    if (s.engine.contact == scenario::ContactModel::hooke) {
        double const net = hooke_stiffness(s.grains, pair, speed) - attraction;
        return net > 0 ? force / net : std::numeric_limits<double>::infinity();
    }
    double const root = balance(hertz_stiffness(s.grains, pair), attraction, force, 2);  // sqrt(d)
    return root * root;
}

double overlap_of_impact(scenario::Scenario const& s, ContactPair const& pair, double speed,
                         double hooke_speed) {
    double const attraction = attraction_per_overlap(s.engine.cohesion, pair);
    double const energy = pair.mass * speed * speed / 2;
    if (s.engine.contact == scenario::ContactModel::hooke) {
        double const net = hooke_stiffness(s.grains, pair, hooke_speed) - attraction;
        return net > 0 ? std::sqrt(2 * energy / net) : std::numeric_limits<double>::infinity();
    }
    // 2/5 K d^(5/2) = attraction d^2 / 2 + energy, in sqrt(d).
    double const root = balance(0.4 * hertz_stiffness(s.grains, pair), attraction / 2, energy, 4);
    return root * root;
}

}  // namespace vibrotrough::prepare
