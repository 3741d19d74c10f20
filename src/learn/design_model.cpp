#include "learn/design_model.hpp"

#include "learn/machine_keys.hpp"
#include "theory/efficiency.hpp"
#include "theory/limits.hpp"
#include "theory/tested_range.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>

#include <fmt/format.h>

namespace vibrotrough::learn {
namespace {

theory::PointMass point_of(theory::Drive const& d, double friction) {
    return {std::clamp(d.throw_number(), 1e-6, theory::largest_throw_number), std::tan(d.vibration_angle),
            std::tan(d.inclination), friction};
}

/// The law for grains whose rolling friction is not known exactly.
class LawOfGrains {
  public:
    /// @param friction  on the trough, at which spread() is looked at
    LawOfGrains(Uncertain const& rolling_friction, double friction)
        : rolling_friction_(rolling_friction), friction_(friction) {}

    /// With the mean of the rolling friction; nothing without a mean speed.
    std::optional<double> efficiency(theory::Drive const& d, double friction) {
        return efficiency(rolling_friction_.mean, point_of(d, friction));
    }

    /// Its standard deviation by the rolling friction. A design asks for many frictions at one drive.
    double spread(theory::Drive const& d) {
        if (rolling_friction_.sd <= 0) return 0;
        theory::PointMass const point = point_of(d, friction_);
        std::array<double, 3> const place{point.throw_number, point.tan_vibration_angle,
                                          point.tan_inclination};
        if (place != last_place_) {
            last_spread_ =
                deviation_of(rolling_friction_, [&](double value) { return efficiency(value, point); });
            last_place_ = place;
        }
        return last_spread_;
    }

  private:
    std::optional<double> efficiency(double rolling_friction, theory::PointMass const& point) {
        auto const law = theory::law_of_grains(std::max(0.0, rolling_friction));
        auto const solver = solvers_.try_emplace(rolling_friction, law).first;
        double const eta = solver->second(point).motion.velocity_efficiency;
        if (!std::isfinite(eta)) return {};
        return eta;
    }

    Uncertain rolling_friction_;
    double friction_;
    std::map<double, theory::RollingLayerSolver> solvers_;  ///< by rolling friction
    std::array<double, 3> last_place_{};
    double last_spread_ = 0;
};

}  // namespace

double DesignModel::missed(theory::Drive const& drive, std::optional<double> depth) const {
    if (discrepancy) return *discrepancy;
    auto const known = known_error(errors, drive.throw_number(), std::tan(drive.inclination), depth);
    return known.value_or(largest_error(errors));
}

std::optional<std::string> DesignModel::untested(theory::Drive const& drive, double friction,
                                                 std::optional<double> depth) const {
    theory::PointMass const point = point_of(drive, friction);
    if (outside) {
        if (auto why = outside(drive, friction, depth)) return why;
    }
    if (errors.empty() || discrepancy || uses_calibrated_discrepancy) return {};
    if (!depth)
        return "the diameter of the grains is not given, on which depends how far the speed may be off; add "
               "--grain-diameter";
    if (known_error(errors, point.throw_number, point.tan_inclination, depth)) return {};
    return fmt::format(
        "no simulated layer tells what {} misses at throw number {:.3g} and tan(alpha) {:.3g} in a layer "
        "{:.3g} "
        "diameters deep",
        name, point.throw_number, point.tan_inclination, *depth);
}

DesignModel point_mass_design_model(std::optional<double> discrepancy) {
    auto const solver = std::make_shared<theory::EfficiencySolver>();
    DesignModel model{.name = "the point mass",
                      .discrepancy = discrepancy,
                      .errors = point_mass_errors(),
                      .is_point_mass = true};
    model.at = [solver](DesignLayer const& layer, double friction) -> std::optional<ModelEfficiency> {
        double const eta = (*solver)(point_of(layer.drive, friction)).velocity_efficiency;
        if (!std::isfinite(eta)) return {};
        return ModelEfficiency{eta, 0};
    };
    // Without a discrepancy of its own it is known as far as layers were simulated.
    model.narrowed = [discrepancy](theory::DriveSpace space) {
        double const most = largest_throw_number(point_mass_errors());
        if (!discrepancy) space.max_throw_number = std::min(space.max_throw_number, most);
        return space;
    };
    model.excess = [](theory::Drive const&) { return -1.0; };
    return model;
}

DesignModel rolling_layer_design_model(std::optional<Uncertain> const& rolling_friction,
                                       std::optional<double> discrepancy, double friction_looked_at) {
    Uncertain const known = rolling_friction.value_or(unknown_rolling_friction());
    auto const law = std::make_shared<LawOfGrains>(known, friction_looked_at);
    DesignModel model{
        .name = "the rolling-layer law", .discrepancy = discrepancy, .errors = rolling_layer_errors()};
    model.at = [law](DesignLayer const& layer, double friction) -> std::optional<ModelEfficiency> {
        auto const eta = law->efficiency(layer.drive, friction);
        if (!eta) return {};
        return ModelEfficiency{*eta, law->spread(layer.drive)};
    };
    std::string const name = rolling_friction ? "rolling friction"
                                              : fmt::format("rolling friction (not given: {:.3g} to {:.3g})",
                                                            known.low(), known.high());
    if (known.sd > 0)
        model.sources = [law, name](DesignLayer const& layer) {
            return std::vector<OwnSource>{{name, law->spread(layer.drive)}};
        };
    double const most = unknown_rolling_friction().high();
    model.outside = [known, most](theory::Drive const& d, double friction,
                                  std::optional<double> depth) -> std::optional<std::string> {
        if (known.mean > most)
            return fmt::format(
                "the rolling-layer law has not been tested with a rolling friction of {:g}, above {:g}",
                known.mean, most);
        return theory::outside_tested_range(point_of(d, friction), depth);
    };
    model.known_range =
        fmt::format("throw numbers of {:g} to {:g} and vibration angles of {:.3g} to {:.3g} degrees",
                    theory::tested_level.throw_number.low, theory::tested_level.throw_number.high,
                    std::atan(theory::tested_tan_vibration_angle.low) / degree,
                    std::atan(theory::tested_tan_vibration_angle.high) / degree);
    model.narrowed = theory::within_tested_range;
    model.excess = [](theory::Drive const& d) { return theory::tested_excess(d); };
    return model;
}

double speed_without_slip(theory::Drive const& drive) {
    double const throw_number = drive.throw_number();
    if (throw_number <= 1) return 0;
    double low = 0, high = 1;  // cycles of flight
    for (int i = 0; i < 60; ++i) {
        double const middle = (low + high) / 2;
        (theory::throw_number_of_flight(middle) < throw_number ? low : high) = middle;
    }
    double const slope =
        std::cos(drive.inclination) / std::tan(drive.vibration_angle) - std::sin(drive.inclination);
    return 9.81 * low * low / (2 * drive.frequency) * slope;
}

std::optional<double> factor_of_rolling_layers(double throw_number) {
    // "4 deep, free" of validation/why_theory_fails and "throw number" of validation/rolling_layer.
    constexpr std::array<double, 9> at{1.15, 1.35, 1.5, 1.6, 1.7, 1.9, 2.0, 2.15, 2.25};
    constexpr std::array<double, 9> layer{.220, .368, .501, .625, .685, .786, .827, .869, .894};
    if (throw_number < 1.2 || throw_number > 2.3) return {};
    std::size_t i = 1;
    while (i + 1 < at.size() && at[i] < throw_number) ++i;
    double const share = std::min(1.0, (throw_number - at[i - 1]) / (at[i] - at[i - 1]));
    double const efficiency = layer[i - 1] + share * (layer[i] - layer[i - 1]);
    return efficiency / theory::solve(theory::PointMass{throw_number, 0.5, 0, 0.23}).velocity_efficiency;
}

}  // namespace vibrotrough::learn
