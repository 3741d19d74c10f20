#include "learn/corrected_model.hpp"

#include "atlas/atlas.hpp"
#include "atlas/tables.hpp"
#include "inference/gaussian_process.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>

namespace vibrotrough::learn {
namespace {

/// In velocity efficiency: no model is more exact, even if it says so.
constexpr double least_error = 0.01;
/// The error of a model counts as known where its standard deviation is at most this share of what it was.
constexpr double known_share = 0.5;

/// Of a simulated value, in units of the expected error, so that two of one place do not contradict each
/// other.
constexpr double least_noise = 1e-3;

/// The first of those of the atlas: throw number, tan(beta), tan(alpha), friction, amplitude over diameter.
constexpr Eigen::Index input_count = 5;

/// A drive and its layer, each input in the lengths over which the error of the law changes.
Eigen::VectorXd place_of(theory::Drive const& d, double friction, double diameter) {
    static auto const lengths = atlas::error_lengths();
    Eigen::VectorXd place(input_count);
    place << d.throw_number(), std::tan(d.vibration_angle), std::tan(d.inclination), friction,
        d.amplitude / diameter;
    for (Eigen::Index k = 0; k < input_count; ++k) {
        auto const input = static_cast<std::size_t>(k);
        place(k) = atlas::inputs()[input].share_of(place(k)) / lengths[input];
    }
    return place;
}

/// A model and what simulated layers say of its error, in units of the error that it expects.
class CorrectedSpeeds : public SpeedModel {
  public:
    CorrectedSpeeds(DesignModel model, std::vector<SimulatedLayer> const& layers, double diameter,
                    double confidence)
        : model_(std::move(model)), diameter_(diameter), confidence_(confidence), error_(process(layers)) {
        for (SimulatedLayer const& layer : layers)
            numerical_error_ = std::max(numerical_error_, layer.numerical_error);
    }

    std::optional<ModelEfficiency> speed(DesignLayer const& layer, double friction,
                                         Precision precision) override {
        auto const value = model_.at(layer, friction, precision);
        if (!value) return {};
        double const expected = expected_error(layer.drive, *value);
        auto const error = error_at(layer.drive, friction);
        return ModelEfficiency{value->efficiency + expected * error.mean, expected * error.sd,
                               numerical_error_ / atlas::deviations_in_half_width};
    }
    Whereabouts where(theory::Drive const& drive, double friction,
                      std::optional<double> depth) const override {
        Whereabouts found{model_.excess(drive)};
        if (error_at(drive, friction).sd > known_share)
            found.why_not = model_.untested(drive, friction, depth);
        return found;
    }
    void narrow(theory::DriveSpace& space, theory::Range& depth) const override {
        model_.speeds->narrow(space, depth);
    }

  private:
    double expected_error(theory::Drive const& drive, ModelEfficiency const& value) const {
        return std::max(least_error, std::hypot(model_.missed(drive, {}, confidence_), value.sd()));
    }

    inference::ProcessValue error_at(theory::Drive const& drive, double friction) const {
        return error_.predict(place_of(drive, friction, diameter_), Eigen::VectorXd::Ones(1));
    }

    inference::GaussianProcess process(std::vector<SimulatedLayer> const& layers) const {
        std::vector<SimulatedLayer> known;
        std::vector<ModelEfficiency> said;
        for (SimulatedLayer const& layer : layers) {
            auto const value = model_.at({layer.drive, layer.depth}, layer.friction);
            if (!value) continue;
            known.push_back(layer);
            said.push_back(*value);
        }
        if (known.empty())
            throw std::invalid_argument("no layer was simulated at which the model has a speed");
        auto const count = static_cast<Eigen::Index>(known.size());
        inference::ProcessData data{Eigen::MatrixXd(count, input_count), Eigen::MatrixXd::Ones(count, 1),
                                    Eigen::VectorXd(count), Eigen::VectorXd(count)};
        for (Eigen::Index i = 0; i < count; ++i) {
            SimulatedLayer const& layer = known[static_cast<std::size_t>(i)];
            ModelEfficiency const& value = said[static_cast<std::size_t>(i)];
            double const expected = expected_error(layer.drive, value);
            data.inputs.row(i) = place_of(layer.drive, layer.friction, diameter_);
            data.values(i) = (layer.efficiency - value.efficiency) / expected;
            data.noise(i) = std::max(
                least_noise, layer.statistics_half_width / atlas::deviations_in_half_width / expected);
        }
        return {data,
                {Eigen::VectorXd::Zero(1), Eigen::VectorXd::Constant(1, std::sqrt(common_share))},
                {std::sqrt(1 - common_share), Eigen::VectorXd::Ones(input_count), 0}};
    }

    DesignModel model_;
    double diameter_, confidence_;
    inference::GaussianProcess error_;
    double numerical_error_ = 0;
};

}  // namespace

DesignModel corrected_design_model(DesignModel const& model, std::vector<SimulatedLayer> const& layers,
                                   double diameter, double confidence) {
    return {.name = model.name,
            .discrepancy = 0,
            .speeds = std::make_shared<CorrectedSpeeds>(model, layers, diameter, confidence),
            .known_range = model.known_range,
            .is_slow = true,
            .remarks = model.remarks};
}

}  // namespace vibrotrough::learn
