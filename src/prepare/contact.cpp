#include "prepare/contact.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <boost/math/tools/toms748_solve.hpp>

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

double effective_modulus(scenario::Grains const& grains) {
    return grains.youngs_modulus.value() / (2 * (1 - grains.poisson_ratio * grains.poisson_ratio));
}

double hooke_stiffness(scenario::Grains const& grains, ContactPair const& pair, double speed) {
    double const elastic = 16.0 / 15 * effective_modulus(grains) * std::sqrt(pair.radius);
    return elastic * std::pow(pair.mass * speed * speed / elastic, 0.2);
}

double restitution_of(double damping_ratio) {
    return std::exp(-damping_ratio * linear_duration(1, 1, damping_ratio));
}

double damping_ratio(double restitution) {
    if (restitution >= 1) return 0;
    double const wanted = std::max(restitution, least_restitution + 3e-4);  // the engine takes no less
    auto const too_elastic = [&](double z) { return restitution_of(z) - wanted; };
    boost::math::tools::eps_tolerance<double> const tolerance(50);
    std::uintmax_t iterations = 100;
    auto const [low, high] =
        boost::math::tools::toms748_solve(too_elastic, 0.0, 0.999999, tolerance, iterations);
    return (low + high) / 2;
}

double nominal_restitution(double restitution) {
    double const z = damping_ratio(restitution);
    return std::exp(-std::numbers::pi * z / std::sqrt(1 - z * z));
}

double linear_duration(double stiffness, double mass, double damping_ratio) {
    double const root = std::sqrt(1 - damping_ratio * damping_ratio);
    return 2 * std::acos(damping_ratio) / (std::sqrt(stiffness / mass) * root);
}

namespace {

/// Attraction of the model sjkr per overlap, N/m: 2 pi R* times the energy density. The area of contact is
/// that of the circle in which the spheres cut each other, 2 pi R* d for small overlaps d (LIGGGHTS, cohesion
/// sjkr).
double attraction_per_overlap(double cohesion, ContactPair const& pair) {
    return 2 * std::numbers::pi * pair.radius * cohesion;
}

/// F = 4/3 E* sqrt(R*) d^(3/2) - 2 pi R* w d, with the energy density w of the attraction.
class HertzContact : public Contact {
  public:
    explicit HertzContact(scenario::Scenario const& s) : grains_(s.grains), cohesion_(s.engine.cohesion) {}

    std::string_view name() const override { return "Hertz"; }

    /// 2.87 (m*^2 / (R* E*^2 v))^(1/5) (Johnson, Contact Mechanics, 1985, section 11.4).
    double duration(ContactPair const& pair, double speed, double) const override {
        double const modulus = effective_modulus(grains_);
        return 2.87 * std::pow(pair.mass * pair.mass / (pair.radius * modulus * modulus * speed), 0.2);
    }

    /// Without attraction (3 F / (4 E* sqrt(R*)))^(2/3) (Johnson, section 4.2).
    double overlap_under(ContactPair const& pair, double force) const override {
        double const root =
            balance(hertz_stiffness(grains_, pair), attraction_per_overlap(cohesion_, pair), force, 2);
        return root * root;
    }

    /// 2/5 K d^(5/2) = attraction d^2 / 2 + energy, in sqrt(d) (Johnson, section 11.4).
    double overlap_of_impact(ContactPair const& pair, double speed) const override {
        double const energy = pair.mass * speed * speed / 2;
        double const root = balance(0.4 * hertz_stiffness(grains_, pair),
                                    attraction_per_overlap(cohesion_, pair) / 2, energy, 4);
        return root * root;
    }

    /// The net force is least at sqrt(d) = pi w sqrt(R*) / E*: (2 pi^3 / 3) w^3 R*^2 / E*^2.
    double pull_off_force(ContactPair const& pair) const override {
        double const modulus = effective_modulus(grains_);
        return 2 * std::pow(std::numbers::pi * cohesion_, 3) / 3 * std::pow(pair.radius / modulus, 2);
    }
    std::optional<double> attraction_ratio(ContactPair const&) const override { return {}; }
    double stiffness_exponent() const override { return 2.0 / 3; }

  private:
    scenario::Grains grains_;
    double cohesion_;
};

/// F = (k - 2 pi R* w) d.
class HookeContact : public Contact {
  public:
    HookeContact(scenario::Scenario const& s, double speed)
        : grains_(s.grains), cohesion_(s.engine.cohesion), speed_(speed) {}

    std::string_view name() const override { return "Hooke"; }

    double duration(ContactPair const& pair, double, double restitution) const override {
        return linear_duration(spring(pair), pair.mass, damping_ratio(restitution));
    }
    double overlap_under(ContactPair const& pair, double force) const override {
        double const net = net_spring(pair);
        return net > 0 ? force / net : std::numeric_limits<double>::infinity();
    }
    double overlap_of_impact(ContactPair const& pair, double speed) const override {
        double const net = net_spring(pair);
        return net > 0 ? speed * std::sqrt(pair.mass / net) : std::numeric_limits<double>::infinity();
    }
    double pull_off_force(ContactPair const&) const override { return 0; }
    std::optional<double> attraction_ratio(ContactPair const& pair) const override {
        return attraction_per_overlap(cohesion_, pair) / spring(pair);
    }
    double stiffness_exponent() const override { return 4.0 / 5; }

  private:
    double spring(ContactPair const& pair) const { return hooke_stiffness(grains_, pair, speed_); }
    double net_spring(ContactPair const& pair) const {
        return spring(pair) - attraction_per_overlap(cohesion_, pair);
    }

    scenario::Grains grains_;
    double cohesion_, speed_;
};

}  // namespace

std::unique_ptr<Contact const> contact_of(scenario::Scenario const& scenario, double speed) {
    switch (scenario.engine.contact) {
        case scenario::ContactModel::hertz:
            return std::make_unique<HertzContact>(scenario);
        case scenario::ContactModel::hooke:
            return std::make_unique<HookeContact>(scenario, speed);
    }
    throw std::invalid_argument("no such contact model");
}

}  // namespace vibrotrough::prepare
