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
class Correction {
  public:
    Correction(DesignModel model, std::vector<SimulatedLayer> const& layers, double diameter)
        : model_(std::move(model)), diameter_(diameter), error_(process(layers)) {
        for (SimulatedLayer const& layer : layers)
            numerical_error_ = std::max(numerical_error_, layer.numerical_error);
    }

    std::optional<ModelEfficiency> at(DesignLayer const& layer, double friction) const {
        return corrected(model_.at(layer, friction), layer.drive, friction);
    }
    std::optional<ModelEfficiency> nearly_at(DesignLayer const& layer, double friction) const {
        return corrected(model_.quickly_at(layer, friction), layer.drive, friction);
    }
    std::optional<std::string> untested(theory::Drive const& drive, double friction,
                                        std::optional<double> depth) const {
        if (error_at(drive, friction).sd <= known_share) return {};
        return model_.untested(drive, friction, depth);
    }

  private:
    std::optional<ModelEfficiency> corrected(std::optional<ModelEfficiency> const& value,
                                             theory::Drive const& drive, double friction) const {
        if (!value) return {};
        double const expected = expected_error(drive, *value);
        auto const error = error_at(drive, friction);
        return ModelEfficiency{value->efficiency + expected * error.mean, expected * error.sd,
                               numerical_error_ / atlas::deviations_in_half_width};
    }

    double expected_error(theory::Drive const& drive, ModelEfficiency const& value) const {
        return std::max(least_error, std::hypot(model_.missed(drive, {}), value.sd()));
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
    double diameter_;
    inference::GaussianProcess error_;
    double numerical_error_ = 0;
};

}  // namespace

DesignModel corrected_design_model(DesignModel const& model, std::vector<SimulatedLayer> const& layers,
                                   double diameter) {
    auto const correction = std::make_shared<Correction const>(model, layers, diameter);
    DesignModel corrected{.name = model.name, .discrepancy = 0};
    corrected.at = [correction](DesignLayer const& layer, double friction) {
        return correction->at(layer, friction);
    };
    corrected.nearly_at = [correction](DesignLayer const& layer, double friction) {
        return correction->nearly_at(layer, friction);
    };
    corrected.outside = [correction](theory::Drive const& d, double friction, std::optional<double> depth) {
        return correction->untested(d, friction, depth);
    };
    corrected.narrowed = model.narrowed;
    corrected.excess = model.excess;
    corrected.depths = model.depths;
    corrected.known_range = model.known_range;
    corrected.remarks = model.remarks;
    return corrected;
}

}  // namespace vibrotrough::learn
