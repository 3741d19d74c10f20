#include "learn/layer_errors.hpp"

#include "atlas/tables.hpp"
#include "atlas/value.hpp"
#include "learn/machine_keys.hpp"
#include "scenario/model/scenario.hpp"
#include "scenario/reader/sample_cube.hpp"
#include "theory/point_mass.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <Eigen/Eigenvalues>

namespace vibrotrough::learn {
namespace {

constexpr int layers_of_the_prior = 256;
/// Common errors that are smaller in all measurements together are left out.
constexpr double least_common_error = discrepancy_prior.low;

/// A layer, as a point of the unit cube over the inputs of the atlas.
class LayerOfTheCube {
  public:
    LayerOfTheCube(std::vector<double> const& cube, std::vector<FreeParameter> const& free,
                   std::map<std::string, double> const& fixed)
        : cube_(cube), free_(free), fixed_(fixed) {}

    /// Its place in a measurement, which may lie outside of the atlas.
    /// @param mean_amplitude  m, of all measurements, which the layer's amplitude in diameters belongs to
    atlas::Place place_at(MeasuredSpeed const& one, double mean_amplitude) const {
        atlas::Place place;
        for (std::size_t input = 0; input < cube_.size(); ++input)
            place.push_back(atlas::inputs()[input].value_at(cube_[input]));
        double const alpha =
            angle("inclination", atlas::tan_inclination_input).value_or(one.inclination.value_or(0));
        double const beta = angle("vibration_angle", atlas::tan_vibration_input)
                                .value_or(one.vibration_angle.value_or(std::atan(place[1])));
        double const omega = 2 * std::numbers::pi * one.frequency;
        place[atlas::throw_number_input] =
            omega * omega * one.amplitude * std::sin(beta) / (scenario::gravity * std::cos(alpha));
        place[atlas::tan_vibration_input] = std::tan(beta);
        place[atlas::tan_inclination_input] = std::tan(alpha);
        place[atlas::friction_input] =
            value("friction", atlas::friction_input).value_or(place[atlas::friction_input]);
        place[atlas::amplitude_input] *= one.amplitude / mean_amplitude;
        return place;
    }

  private:
    /// Of a quantity that is free or fixed; nothing where the measurement has its own.
    std::optional<double> value(std::string const& name, atlas::Input input) const {
        if (auto const known = fixed_.find(name); known != fixed_.end()) return known->second;
        auto const found = std::ranges::find(free_, name, &FreeParameter::name);
        if (found == free_.end()) return {};
        auto [low, high] = found->prior;
        if (name == "friction") {
            low = std::max(low, atlas::inputs()[input].low);
            high = std::max(low, std::min(high, atlas::inputs()[input].high));
        }
        return low + (high - low) * cube_[input];
    }

    std::optional<double> angle(std::string const& name, atlas::Input input) const {
        auto const degrees = value(name, input);
        return degrees ? std::optional(*degrees * degree) : std::nullopt;
    }

    std::vector<double> const& cube_;
    std::vector<FreeParameter> const& free_;
    std::map<std::string, double> const& fixed_;
};

/// Velocity efficiency of the atlas less that of the point mass; nothing where one of them has none or the
/// atlas has no such layers, and 0 where it knows nothing.
std::optional<double> error_of_the_mass(atlas::Place const& given) {
    if (atlas::is_far_outside(given)) return 0;
    atlas::Place const place = atlas::within_ranges(given);
    if (!atlas::outside_together(place).empty()) return {};
    auto const layer = atlas::efficiency_at(place);
    theory::Motion const mass =
        theory::solve(theory::PointMass{place[atlas::throw_number_input], place[atlas::tan_vibration_input],
                                        place[atlas::tan_inclination_input], place[atlas::friction_input]});
    if (!layer || !mass.converged) return {};
    return *layer - mass.velocity_efficiency;
}

}  // namespace

Eigen::MatrixXd point_mass_layer_errors(std::vector<FreeParameter> const& free,
                                        std::map<std::string, double> const& fixed,
                                        std::vector<MeasuredSpeed> const& speeds) {
    auto const count = static_cast<Eigen::Index>(speeds.size());
    double mean_amplitude = 0;
    for (MeasuredSpeed const& one : speeds)
        mean_amplitude += one.amplitude / static_cast<double>(speeds.size());
    Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(count, count);
    int layers = 0;
    for (auto const& cube : scenario::sample_cube(scenario::SampleMethod::sobol, layers_of_the_prior,
                                                  static_cast<int>(atlas::inputs().size()), 1)) {
        LayerOfTheCube const layer(cube, free, fixed);
        Eigen::VectorXd errors(count);
        bool has_all = true;
        for (Eigen::Index i = 0; i < count && has_all; ++i) {
            auto const error =
                error_of_the_mass(layer.place_at(speeds[static_cast<std::size_t>(i)], mean_amplitude));
            has_all = error.has_value();
            errors[i] = error.value_or(0);
        }
        if (!has_all) continue;
        squares += errors * errors.transpose();
        ++layers;
    }
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> const parts(squares / std::max(1, layers));
    Eigen::Index const kept = (parts.eigenvalues().array() > least_common_error * least_common_error).count();
    return parts.eigenvectors().rightCols(kept) * parts.eigenvalues().tail(kept).cwiseSqrt().asDiagonal();
}

}  // namespace vibrotrough::learn
