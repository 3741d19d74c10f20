#include "learn/speed_model.hpp"

#include "learn/machine_keys.hpp"
#include "theory/efficiency.hpp"
#include "theory/rolling_layer.hpp"
#include "theory/tested_range.hpp"

#include <algorithm>
#include <array>
#include <map>

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <fmt/format.h>

namespace vibrotrough::learn {
namespace {

class PointMassSpeeds : public SpeedModel {
  public:
    /// @param most  throw number, at which its error is known
    explicit PointMassSpeeds(double most) : most_(most) {}

    std::optional<ModelEfficiency> speed(DesignLayer const& layer, double friction, Precision) override {
        double const eta = solver_(point_of(layer.drive, friction)).velocity_efficiency;
        if (!std::isfinite(eta)) return {};
        return ModelEfficiency{eta, 0};
    }
    Whereabouts where(theory::Drive const&, double, std::optional<double>) const override { return {}; }
    void narrow(theory::DriveSpace& space, theory::Range&) const override {
        space.max_throw_number = std::min(space.max_throw_number, most_);
    }

  private:
    double most_;
    theory::EfficiencySolver solver_;
};

/// The law for grains whose rolling friction is not known exactly.
class RollingLayerSpeeds : public SpeedModel {
  public:
    /// @param given  whether somebody gave the rolling friction
    /// @param looked_at  friction on the trough, at which the spread by the rolling friction is looked at
    RollingLayerSpeeds(Uncertain const& rolling_friction, bool given, double looked_at)
        : rolling_friction_(rolling_friction),
          name_(given ? "rolling friction"
                      : fmt::format("rolling friction (not given: {:.3g} to {:.3g})", rolling_friction.low(),
                                    rolling_friction.high())),
          looked_at_(looked_at) {}

    std::optional<ModelEfficiency> speed(DesignLayer const& layer, double friction, Precision) override {
        auto const eta = efficiency(rolling_friction_.mean, point_of(layer.drive, friction));
        if (!eta) return {};
        if (rolling_friction_.sd <= 0) return ModelEfficiency{*eta, 0};
        double const sd = spread(layer.drive);
        return ModelEfficiency{*eta, sd, 0, {{name_, sd}}};
    }
    std::optional<double> near_efficiency(DesignLayer const& layer, double friction) override {
        return efficiency(rolling_friction_.mean, point_of(layer.drive, friction));
    }
    Whereabouts where(theory::Drive const& drive, double friction,
                      std::optional<double> depth) const override {
        Whereabouts found{theory::tested_excess(drive)};
        double const most = unknown_rolling_friction().high();
        found.why_not = rolling_friction_.mean > most
                            ? fmt::format(
                                  "the rolling-layer law has not been tested with a rolling friction "
                                  "of {:g}, above {:g}",
                                  rolling_friction_.mean, most)
                            : theory::outside_tested_range(point_of(drive, friction), depth);
        return found;
    }
    void narrow(theory::DriveSpace& space, theory::Range&) const override {
        space = theory::within_tested_range(space);
    }

  private:
    std::optional<double> efficiency(double rolling_friction, theory::PointMass const& point) {
        auto const law = theory::law_of_grains(std::max(0.0, rolling_friction));
        auto const solver = solvers_.try_emplace(rolling_friction, law).first;
        double const eta = solver->second(point).motion.velocity_efficiency;
        return std::isfinite(eta) ? std::optional(eta) : std::nullopt;
    }

    /// Standard deviation by the rolling friction. A design asks for many frictions at one drive.
    double spread(theory::Drive const& d) {
        theory::PointMass const point = point_of(d, looked_at_);
        std::array<double, 3> const place{point.throw_number, point.tan_vibration_angle,
                                          point.tan_inclination};
        if (place != last_place_) {
            last_spread_ =
                deviation_of(rolling_friction_, [&](double value) { return efficiency(value, point); });
            last_place_ = place;
        }
        return last_spread_;
    }

    Uncertain rolling_friction_;
    std::string name_;
    double looked_at_;
    std::map<double, theory::RollingLayerSolver> solvers_;  ///< by rolling friction
    std::array<double, 3> last_place_{};
    double last_spread_ = 0;
};

/// By how much Student's t with so many degrees of freedom is wider at a confidence than at the usual one,
/// each over the normal distribution.
double widening(int degrees_of_freedom, double confidence) {
    if (confidence <= usual_confidence) return 1;
    boost::math::students_t const t(degrees_of_freedom);
    boost::math::normal const normal;
    auto const wider = [&](double p) { return quantile(t, p) / quantile(normal, p); };
    return wider(confidence) / wider(usual_confidence);
}

}  // namespace

double DesignModel::missed(theory::Drive const& drive, std::optional<double> depth, double confidence) const {
    if (discrepancy) return *discrepancy;
    auto const* const row = known_row(errors, drive.throw_number(), std::tan(drive.inclination), depth);
    return row != nullptr ? row->sd * widening(row->layers, confidence) : largest_error(errors);
}

std::optional<std::string> DesignModel::untested(theory::Drive const& drive, double friction,
                                                 std::optional<double> depth) const {
    if (auto why = speeds->where(drive, friction, depth).why_not) return why;
    if (errors.empty() || discrepancy || uses_calibrated_discrepancy) return {};
    if (!depth)
        return "the diameter of the grains is not given, on which depends how far the speed may be off; add "
               "--grain-diameter";
    theory::PointMass const point = point_of(drive, friction);
    if (known_error(errors, point.throw_number, point.tan_inclination, depth)) return {};
    return fmt::format(
        "no simulated layer tells what {} misses at throw number {:.3g} and tan(alpha) {:.3g} in a layer "
        "{:.3g} diameters deep",
        name, point.throw_number, point.tan_inclination, *depth);
}

DesignModel point_mass_design_model(std::optional<double> discrepancy) {
    // Without a discrepancy of its own it is known as far as layers were simulated.
    double const most = discrepancy ? HUGE_VAL : largest_throw_number(point_mass_errors());
    return {.name = "the point mass",
            .discrepancy = discrepancy,
            .errors = point_mass_errors(),
            .speeds = std::make_shared<PointMassSpeeds>(most),
            .is_point_mass = true};
}

DesignModel rolling_layer_design_model(std::optional<Uncertain> const& rolling_friction,
                                       std::optional<double> discrepancy, double friction_looked_at) {
    return {
        .name = "the rolling-layer law",
        .discrepancy = discrepancy,
        .errors = rolling_layer_errors(),
        .speeds = std::make_shared<RollingLayerSpeeds>(rolling_friction.value_or(unknown_rolling_friction()),
                                                       rolling_friction.has_value(), friction_looked_at),
        .known_range =
            fmt::format("throw numbers of {:g} to {:g} and vibration angles of {:.3g} to {:.3g} degrees",
                        theory::tested_level.throw_number.low, theory::tested_level.throw_number.high,
                        std::atan(theory::tested_tan_vibration_angle.low) / degree,
                        std::atan(theory::tested_tan_vibration_angle.high) / degree)};
}

}  // namespace vibrotrough::learn
