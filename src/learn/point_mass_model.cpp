#include "learn/point_mass_model.hpp"

#include "core/error.hpp"
#include "learn/given_quantities.hpp"
#include "learn/machine_keys.hpp"
#include "scenario/model/scenario.hpp"
#include "theory/conveyor.hpp"
#include "theory/efficiency.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

namespace vibrotrough::learn {
namespace {

using Values = std::map<std::string, double>;

/// The quantities in the order of point_mass_parameters(); what is not given is empty.
enum Quantity : std::size_t {
    friction,
    static_friction,
    landing_friction,
    restitution,
    inclination,
    vibration_angle,
    quantity_count,
};
using Given = std::array<std::optional<double>, quantity_count>;

std::size_t index_of(std::string const& name) {
    auto const& known = point_mass_parameters();
    return static_cast<std::size_t>(std::ranges::find(known, name, &FreeParameter::name) - known.begin());
}

class PointMassModel {
  public:
    PointMassModel(std::vector<std::string> const& free, Values const& fixed)
        : solvers_(std::make_shared<std::map<int, theory::EfficiencySolver>>()) {
        for (auto const& [name, value] : fixed) given_[index_of(name)] = value;
        for (std::string const& name : free) free_.push_back(index_of(name));
        plastic_ = true;
        for (std::size_t const q : {static_friction, landing_friction, restitution})
            plastic_ = plastic_ && !given_[q] && std::ranges::find(free_, q) == free_.end();
    }

    std::optional<ModelSpeed> operator()(std::span<double const> values,
                                         MeasuredSpeed const& measured) const {
        Given all = given_;
        for (std::size_t i = 0; i < free_.size(); ++i) all[free_[i]] = values[i];
        double const beta = all[vibration_angle] ? *all[vibration_angle] * degree : *measured.vibration_angle;
        double const alpha = all[inclination] ? *all[inclination] * degree : measured.inclination.value_or(0);
        double const omega = 2 * std::numbers::pi * measured.frequency;
        theory::PointMass const point{
            omega * omega * measured.amplitude * std::sin(beta) / (scenario::gravity * std::cos(alpha)),
            std::tan(beta), std::tan(alpha), *all[friction]};
        auto const eta = plastic_ ? plastic_efficiency(point, measured.line)
                                  : general_efficiency(point, all, measured.line);
        if (!eta) return {};
        double const trough_speed = omega * measured.amplitude * std::cos(beta);
        return ModelSpeed{*eta * trough_speed, 0, trough_speed, 0};
    }

  private:
    /// Nothing when the mass has no steady speed.
    std::optional<double> plastic_efficiency(theory::PointMass const& point, int line) const {
        theory::Efficiency const answer = (*solvers_)[line](point);
        if (!is_steady(answer.outcome)) return {};
        return answer.velocity_efficiency;
    }

    /// The same; and nothing when static friction would be below kinetic friction.
    std::optional<double> general_efficiency(theory::PointMass const& point, Given const& all,
                                             int line) const {
        theory::Conveyor conveyor{};
        conveyor.point = point;
        conveyor.static_friction = all[static_friction].value_or(0);
        conveyor.landing_friction = all[landing_friction];
        conveyor.restitution = all[restitution].value_or(0);
        if (all[static_friction] && conveyor.static_friction < point.friction) return {};
        theory::Efficiency const answer = (*solvers_)[line].solve(conveyor);
        if (!is_steady(answer.outcome)) return {};
        return answer.velocity_efficiency;
    }

    static bool is_steady(theory::Outcome outcome) {
        return outcome == theory::Outcome::periodic || outcome == theory::Outcome::unsettled;
    }

    Given given_;
    std::vector<std::size_t> free_;
    bool plastic_;
    /// One for each line of the table, because a solver is fastest while the throw number stays the same.
    std::shared_ptr<std::map<int, theory::EfficiencySolver>> solvers_;
};

}  // namespace

std::vector<FreeParameter> const& point_mass_parameters() {
    static std::vector<FreeParameter> const parameters{
        {"friction", "1", {0.02, 1.2}},       {"static_friction", "1", {0.02, 2}},
        {"landing_friction", "1", {0, 1.2}},  {"restitution", "1", {0, 0.6}},
        {"inclination", "degree", {-10, 10}}, {"vibration_angle", "degree", {5, 60}}};
    return parameters;
}

CalibrationModel point_mass_model(std::vector<std::string> const& free, Values const& fixed,
                                  std::vector<MeasuredSpeed> const& speeds) {
    check_given(free, fixed, point_mass_parameters(), "the point mass", speeds);
    if (std::ranges::find(free, "friction") == free.end() && !fixed.contains("friction"))
        throw core::InputError(
            "the friction is not known; add it to --free, or give it with --fix friction=0.3");
    return PointMassModel(free, fixed);
}

}  // namespace vibrotrough::learn
