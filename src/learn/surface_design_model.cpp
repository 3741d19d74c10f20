#include "learn/surface_design_model.hpp"

#include "atlas/atlas.hpp"
#include "atlas/tables.hpp"
#include "core/error.hpp"
#include "learn/machine_keys.hpp"
#include "prepare/prepared_case.hpp"
#include "scenario/reader/keys.hpp"
#include "theory/efficiency.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace vibrotrough::learn {
namespace {

constexpr char const* friction_key = "trough.friction";
constexpr double same_coefficient = 0.005;  // two that are so close count as one

/// Where an input of the surface comes from: the drive, the friction, or the user.
struct Source {
    scenario::Key const* machine;
    bool is_friction;
    double value;  ///< given by the user
};

std::vector<Source> sources_of(std::vector<atlas::SurfaceInput> const& inputs,
                               std::map<std::string, double> const& given) {
    std::vector<Source> sources;
    for (atlas::SurfaceInput const& input : inputs) {
        scenario::Key const* const machine = machine_key(input.key);
        bool const is_friction = input.key == friction_key;
        auto const found = given.find(input.key);
        if (machine == nullptr && !is_friction && found == given.end()) {
            throw core::InputError(
                fmt::format("the campaign varies {0}: say its value for this material, for "
                            "example --at {0}={1:g}",
                            input.key, (input.low + input.high) / 2));
        }
        if (found != given.end() && (machine != nullptr || is_friction))
            throw core::InputError(fmt::format("--at {}: the design chooses it; leave it out", input.key));
        sources.push_back({machine, is_friction, found == given.end() ? 0 : found->second});
    }
    for (auto const& [key, value] : given) {
        if (std::ranges::find(inputs, key, &atlas::SurfaceInput::key) == inputs.end())
            throw core::InputError(fmt::format("--at {}: the campaign does not vary it", key));
    }
    return sources;
}

/// Whether the campaign varies a key of a group, such as "amplitude" (trough.amplitude, trough.stroke).
bool varies(std::vector<atlas::SurfaceInput> const& inputs, std::string_view group) {
    return std::ranges::any_of(inputs, [&](atlas::SurfaceInput const& input) {
        return scenario::find_key(input.key)->group == group;
    });
}

/// The range that is left where the campaign does not vary a quantity: its value, if it is allowed.
theory::Range fixed_at(char const* name, theory::Range const& range, double value, double in_unit,
                       char const* unit) {
    double const slack = 1e-9 * std::max(std::abs(range.low), std::abs(range.high));
    if (value >= range.low - slack && value <= range.high + slack) {
        double const inside = std::clamp(value, range.low, range.high);
        return {inside, inside};
    }
    throw std::invalid_argument(fmt::format(
        "the campaign was simulated with a {} of {:.4g} {}, outside the range {:.4g} to {:.4g} {}", name,
        in_unit * value, unit, in_unit * range.low, in_unit * range.high, unit));
}

/// The surface at the drives of a design.
class SurfaceSpeeds : public SpeedModel {
  public:
    SurfaceSpeeds(std::shared_ptr<atlas::Surface const> surface, CampaignTrend trend,
                  std::vector<Source> sources, double numerics)
        : surface_(std::move(surface)),
          trend_(std::move(trend)),
          sources_(std::move(sources)),
          numerics_(numerics),
          varies_friction_(std::ranges::any_of(sources_, &Source::is_friction)) {
        atlas::Place middle;
        for (std::size_t k = 0; k < sources_.size(); ++k) {
            atlas::SurfaceInput const& input = surface_->inputs()[k];
            bool const chosen = sources_[k].machine != nullptr || sources_[k].is_friction;
            middle.push_back(chosen ? (input.low + input.high) / 2 : sources_[k].value);
            if (sources_[k].is_friction) frictions_ = {input.low, input.high};
        }
        layer_ = trend_.scenario_at(middle);
        if (!varies_friction_)
            frictions_ = {layer_.trough.friction - same_coefficient,
                          layer_.trough.friction + same_coefficient};
        prepare::PreparedCase const prepared = prepare::prepare_case(layer_);
        is_plain_ = prepared.point_mass.is_plain;
        if (trend_.is_atlas()) atlas_place_ = atlas::place_of(prepared);
    }

    /// The campaign's case in the middle of the ranges that a design may choose from.
    scenario::Scenario const& layer() const { return layer_; }
    /// The frictions on the trough at which the campaign simulated its layer.
    theory::Range const& frictions() const { return frictions_; }

    std::optional<ModelEfficiency> speed(DesignLayer const& layer, double friction, Precision) override {
        theory::Drive const& drive = layer.drive;
        std::vector<double> const asked{drive.frequency, drive.amplitude, drive.vibration_angle,
                                        drive.inclination, varies_friction_ ? friction : 0};
        if (asked == last_asked_) return last_;
        last_asked_ = asked;
        last_ = compute(drive, friction);
        return last_;
    }

    Whereabouts where(theory::Drive const& drive, double friction, std::optional<double>) const override {
        Whereabouts found;
        for (std::size_t k = 0; k < sources_.size(); ++k) {
            if (sources_[k].machine == nullptr) continue;
            atlas::SurfaceInput const& input = surface_->inputs()[k];
            double const value = value_at(*sources_[k].machine, drive), width = input.high - input.low;
            found.excess =
                std::max({found.excess, (value - input.high) / width, (input.low - value) / width});
        }
        if (friction < frictions_.low || friction > frictions_.high)
            found.why_not = fmt::format("the campaign has frictions of {:.3g} to {:.3g}, and not {:.3g}",
                                        frictions_.low, frictions_.high, friction);
        return found;
    }

    /// What the campaign does not vary of the machine, and the depth, stay as they are there.
    void narrow(theory::DriveSpace& space, theory::Range& depth) const override {
        scenario::Trough const& trough = layer_.trough;
        auto const fix = [&](char const* key, char const* name, theory::Range& range, double value,
                             double in_unit, char const* unit) {
            if (!varies(surface_->inputs(), scenario::find_key(key)->group))
                range = fixed_at(name, range, value, in_unit, unit);
        };
        fix("trough.amplitude", "stroke", space.amplitude, trough.amplitude, 2000, "mm");
        fix("trough.vibration_angle", "vibration angle", space.vibration_angle, trough.vibration_angle,
            1 / degree, "degrees");
        fix("trough.inclination", "inclination", space.inclination, trough.inclination, 1 / degree,
            "degrees");
        double const simulated = scenario::layer_height(layer_);
        depth = {std::max(depth.low, simulated), std::min(depth.high, simulated)};
    }

  private:
    std::optional<ModelEfficiency> compute(theory::Drive const& drive, double friction) {
        atlas::Place place;
        for (Source const& source : sources_) {
            place.push_back(source.machine != nullptr ? value_at(*source.machine, drive)
                            : source.is_friction      ? friction
                                                      : source.value);
        }
        auto const trend = trend_at(place, drive, friction);
        if (!trend) return {};
        atlas::SurfaceValue const value = surface_->at(place, *trend);
        return ModelEfficiency{value.efficiency, value.half_width / atlas::deviations_in_half_width,
                               numerics_ / atlas::deviations_in_half_width};
    }

    /// The trend at a place: fast for a plain sinusoid, else by the case itself.
    std::optional<double> trend_at(atlas::Place const& place, theory::Drive const& drive, double friction) {
        if (!is_plain_) return trend_.efficiency_at(place);
        double const mu = varies_friction_ ? friction : layer_.trough.friction;
        if (atlas_place_) {
            atlas::Place at = *atlas_place_;
            at[atlas::throw_number_input] = drive.throw_number();
            at[atlas::tan_vibration_input] = std::tan(drive.vibration_angle);
            at[atlas::tan_inclination_input] = std::tan(drive.inclination);
            at[atlas::friction_input] = mu;
            at[atlas::amplitude_input] *= drive.amplitude / layer_.trough.amplitude;
            return atlas::efficiency_at(atlas::within_ranges(at));
        }
        double const eta = solver_(point_of(drive, mu)).velocity_efficiency;
        return std::isfinite(eta) ? std::optional(eta) : std::nullopt;
    }

    std::shared_ptr<atlas::Surface const> surface_;
    CampaignTrend trend_;
    std::vector<Source> sources_;
    double numerics_;  ///< 95 % bound, in velocity efficiency
    bool varies_friction_, is_plain_ = false;
    theory::Range frictions_{};
    scenario::Scenario layer_;
    std::optional<atlas::Place> atlas_place_;  ///< of that case, where the atlas is the trend
    std::vector<double> last_asked_;           ///< drive and friction
    std::optional<ModelEfficiency> last_;
    theory::EfficiencySolver solver_;
};

/// The material must be one that was simulated. @param value  of the material
void check_material(char const* key, double simulated, double value, double slack, double in_unit,
                    char const* unit) {
    if (std::abs(value - simulated) <= slack) return;
    throw core::InputError(fmt::format(
        "the campaign was simulated with {0} = {1:.4g}{3} and the material has {2:.4g}{3}; simulate "
        "it so, or vary {0} in the campaign",
        key, in_unit * simulated, in_unit * value, unit));
}

constexpr double same_size = 0.01;  // of the diameter

void check_grains(scenario::Grains const& simulated, KnownGrains const& given) {
    if (given.diameter)
        check_material("grains.diameter", simulated.diameter, *given.diameter, same_size * simulated.diameter,
                       1e3, " mm");
    // One that is not known exactly must be the simulated one at both ends of its central 95 %.
    auto const check_ends = [](char const* key, double value, std::optional<Uncertain> const& material) {
        for (double const deviations : {0.0, -1.96, 1.96})
            if (material)
                check_material(key, value, material->mean + deviations * material->sd, same_coefficient, 1,
                               "");
    };
    check_ends("grains.rolling_friction", simulated.rolling_friction, given.rolling_friction);
    check_ends("grains.friction", simulated.friction, given.friction);
}

void check_friction(theory::Range const& simulated, KnownFriction const& known) {
    if (known.median >= simulated.low && known.median <= simulated.high) return;
    throw core::InputError(
        fmt::format("the campaign was simulated with trough.friction = {:.4g} to {:.4g} and the material has "
                    "{:.4g}; simulate it, too",
                    simulated.low, simulated.high, known.median));
}

}  // namespace

DesignModel surface_design_model(std::shared_ptr<atlas::Surface const> surface, CampaignTrend const& trend,
                                 std::map<std::string, double> const& given, KnownMaterial const& material,
                                 double numerics, double discrepancy) {
    auto const inputs = surface->inputs();
    if (!varies(inputs, scenario::find_key("trough.frequency")->group)) {
        throw core::InputError(
            "the campaign varies neither throw number, machine number nor frequency, so that there is "
            "nothing "
            "to choose; vary one of them");
    }
    auto const speeds = std::make_shared<SurfaceSpeeds>(surface, trend, sources_of(inputs, given), numerics);
    check_friction(speeds->frictions(), material.friction);
    check_grains(speeds->layer().grains, material.grains);
    return {
        .name = "the simulated layer",
        .discrepancy = discrepancy,
        .speeds = speeds,
        .known_range = fmt::format("a layer {:.3g} mm deep", 1e3 * scenario::layer_height(speeds->layer())),
        .remarks = surface->doubts()};
}

}  // namespace vibrotrough::learn
