#pragma once

#include "learn/risk_design.hpp"

#include <functional>
#include <utility>

namespace vibrotrough::learn {

/// A model that says what a function says, and knows every layer.
class SpeedsByFunction : public SpeedModel {
  public:
    using Function = std::function<std::optional<ModelEfficiency>(DesignLayer const&, double friction)>;
    explicit SpeedsByFunction(Function function) : function_(std::move(function)) {}
    std::optional<ModelEfficiency> speed(DesignLayer const& layer, double friction, Precision) override {
        return function_(layer, friction);
    }
    Whereabouts where(theory::Drive const&, double, std::optional<double>) const override { return {}; }
    void narrow(theory::DriveSpace&, theory::Range&) const override {}

  private:
    Function function_;
};

/// 12 t/h of pellets on a trough 0.3 m wide, by a point mass whose error is stated, so that it is known for
/// grains of any size.
inline DesignTask pellets() {
    DesignTask task{};
    task.space.max_machine_number = 4;
    task.models = {point_mass_design_model(0.1)};
    task.friction = normal_friction(0.3, 0.03);
    task.bulk_density = 600;
    task.width = 0.3;
    task.length = 3;
    task.mass_flow = 12 / 3.6;
    task.depth = {0.005, 0.04};
    return task;
}

}  // namespace vibrotrough::learn
