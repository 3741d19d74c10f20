#include "learn/point_mass_model.hpp"

#include "core/error.hpp"
#include "learn/given_quantities.hpp"
#include "learn/machine_keys.hpp"
#include "theory/conveyor.hpp"
#include "theory/efficiency.hpp"

#include <memory>

namespace vibrotrough::learn {
namespace {

/// The quantities in the order of point_mass_parameters().
enum Quantity : std::size_t { friction, static_friction, landing_friction, restitution };

class PointMassModel {
  public:
    explicit PointMassModel(GivenQuantities given) : given_(std::move(given)) {}

    /// Nothing when the mass has no steady speed, or static friction would be below kinetic friction.
    std::optional<ModelSpeed> operator()(std::span<double const> values,
                                         MeasuredSpeed const& measured) const {
        GivenQuantities::Values const all = given_.at(values);
        theory::Drive const drive = given_.drive(all, measured);
        theory::Conveyor conveyor{};
        conveyor.point = point_of(drive, *all[friction]);
        conveyor.static_friction = all[static_friction].value_or(0);
        conveyor.landing_friction = all[landing_friction];
        conveyor.restitution = all[restitution].value_or(0);
        if (all[static_friction] && conveyor.static_friction < conveyor.point.friction) return {};
        theory::Efficiency const answer = (*solvers_)[measured.line].solve(conveyor);
        bool const is_steady =
            answer.outcome == theory::Outcome::periodic || answer.outcome == theory::Outcome::unsettled;
        if (!is_steady) return {};
        double const trough_speed = drive.trough_speed();
        return ModelSpeed{answer.velocity_efficiency * trough_speed, 0, trough_speed, 0};
    }

  private:
    GivenQuantities given_;
    /// One for each line of the table, because a solver is fastest while the throw number stays the same.
    std::shared_ptr<std::map<int, theory::EfficiencySolver>> solvers_ =
        std::make_shared<std::map<int, theory::EfficiencySolver>>();
};

}  // namespace

std::vector<FreeParameter> const& point_mass_parameters() {
    static std::vector<FreeParameter> const parameters{
        {"friction", "1", {0.02, 1.2}},       {"static_friction", "1", {0.02, 2}},
        {"landing_friction", "1", {0, 1.2}},  {"restitution", "1", {0, 0.6}},
        {"inclination", "degree", {-10, 10}}, {"vibration_angle", "degree", {5, 60}}};
    return parameters;
}

CalibrationModel point_mass_model(std::vector<std::string> const& free,
                                  std::map<std::string, double> const& fixed,
                                  std::vector<MeasuredSpeed> const& speeds) {
    GivenQuantities const given(free, fixed, point_mass_parameters(), "the point mass", speeds);
    if (!given.has("friction"))
        throw core::InputError(
            "the friction is not known; add it to --free, or give it with --fix friction=0.3");
    return PointMassModel(given);
}

}  // namespace vibrotrough::learn
