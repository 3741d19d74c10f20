#include "learn/atlas_speed_model.hpp"

#include "atlas/atlas.hpp"
#include "atlas/tables.hpp"
#include "core/error.hpp"
#include "learn/corrected_model.hpp"
#include "learn/given_quantities.hpp"
#include "learn/machine_keys.hpp"
#include "scenario/model/scenario.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace vibrotrough::learn {
namespace {

/// The place of a quantity in atlas_parameters().
enum Quantity : std::size_t {
    friction,
    grain_friction,
    rolling_friction,
    restitution,
    depth,
    inclination,
    vibration_angle,
    quantity_count,
};
using Given = std::array<std::optional<double>, quantity_count>;

inference::Bounds bounds_of(atlas::Input input) {
    return {atlas::inputs()[input].low, atlas::inputs()[input].high};
}

inference::Bounds degrees_of(atlas::Input tangent) {
    auto const [low, high] = bounds_of(tangent);
    return {std::atan(low) / degree, std::atan(high) / degree};
}

class AtlasSpeedModel {
  public:
    AtlasSpeedModel(double diameter, std::vector<std::string> const& free,
                    std::map<std::string, double> const& fixed)
        : diameter_(diameter) {
        for (auto const& [name, value] : fixed) given_[index_of(name)] = value;
        for (std::string const& name : free) free_.push_back(index_of(name));
    }

    std::optional<ModelSpeed> operator()(std::span<double const> values,
                                         MeasuredSpeed const& measured) const {
        Given all = given_;
        for (std::size_t i = 0; i < free_.size(); ++i) all[free_[i]] = values[i];
        atlas::Place const place = place_of(all, measured);
        if (!atlas::outside_ranges(place).empty()) return {};
        auto const answer = atlas::value_at(place);
        if (!answer) return {};
        double const trough_speed = 2 * std::numbers::pi * measured.frequency * measured.amplitude /
                                    std::hypot(1, place[atlas::tan_vibration_input]);
        double const numerics = atlas::numerical_error() / atlas::deviations_in_half_width;
        double const whole = answer->half_width / atlas::deviations_in_half_width;
        double const statistics = whole * whole - numerics * numerics;
        double const common = common_share * statistics + numerics * numerics;
        return ModelSpeed{answer->efficiency * trough_speed,
                          std::sqrt((1 - common_share) * statistics) * trough_speed, trough_speed,
                          std::sqrt(common) * trough_speed};
    }

    /// @throws core::InputError when the atlas lacks a measurement, whatever the free quantities are
    void check(MeasuredSpeed const& measured) const {
        Given all = given_;
        for (std::size_t const q : free_)
            all[q] = (atlas_parameters()[q].prior.low + atlas_parameters()[q].prior.high) / 2;
        atlas::Place const place = place_of(all, measured);
        // A free angle moves the throw number.
        bool const may_move = std::ranges::find(free_, vibration_angle) != free_.end() ||
                              std::ranges::find(free_, inclination) != free_.end();
        for (atlas::Outside const& one : atlas::outside_ranges(place)) {
            if (may_move && one.name == atlas::inputs()[atlas::throw_number_input].key) continue;
            throw core::InputError(
                fmt::format("line {}: outside of the atlas: {}; leave the line out, or use the point mass",
                            measured.line, one.why));
        }
    }

    static std::size_t index_of(std::string const& name) {
        auto const& known = atlas_parameters();
        return static_cast<std::size_t>(std::ranges::find(known, name, &FreeParameter::name) - known.begin());
    }

  private:
    atlas::Place place_of(Given const& all, MeasuredSpeed const& measured) const {
        double const beta = all[vibration_angle] ? *all[vibration_angle] * degree : *measured.vibration_angle;
        double const alpha = all[inclination] ? *all[inclination] * degree : measured.inclination.value_or(0);
        double const omega = 2 * std::numbers::pi * measured.frequency;
        return {omega * omega * measured.amplitude * std::sin(beta) / (scenario::gravity * std::cos(alpha)),
                std::tan(beta),
                std::tan(alpha),
                *all[friction],
                measured.amplitude / diameter_,
                *all[depth],
                *all[grain_friction],
                *all[rolling_friction],
                *all[restitution]};
    }

    double diameter_;
    Given given_;
    std::vector<std::size_t> free_;
};

}  // namespace

std::vector<FreeParameter> const& atlas_parameters() {
    static std::vector<FreeParameter> const parameters{
        {"friction", "1", bounds_of(atlas::friction_input)},
        {"grain_friction", "1", bounds_of(atlas::grain_friction_input)},
        {"rolling_friction", "1", bounds_of(atlas::rolling_friction_input)},
        {"restitution", "1", bounds_of(atlas::restitution_input)},
        {"depth", "diameters", bounds_of(atlas::depth_input)},
        {"inclination", "degree", degrees_of(atlas::tan_inclination_input)},
        {"vibration_angle", "degree", degrees_of(atlas::tan_vibration_input)}};
    return parameters;
}

std::vector<std::string> with_unknown_layer(std::vector<std::string> free,
                                            std::map<std::string, double> const& fixed) {
    for (std::size_t q = friction; q <= depth; ++q) {
        std::string const& name = atlas_parameters()[q].name;
        if (!fixed.contains(name) && std::ranges::find(free, name) == free.end()) free.push_back(name);
    }
    return free;
}

CalibrationModel atlas_speed_model(double diameter, std::vector<std::string> const& free,
                                   std::map<std::string, double> const& fixed,
                                   std::vector<MeasuredSpeed> const& speeds) {
    check_given(free, fixed, atlas_parameters(), "a layer of spheres", speeds);
    for (auto const& [name, value] : fixed) {
        auto const [low, high] = atlas_parameters()[AtlasSpeedModel::index_of(name)].prior;
        if (value < low || value > high)
            throw core::InputError(
                fmt::format("--fix {}={:g}: the atlas has {:.3g} to {:.3g}", name, value, low, high));
    }
    AtlasSpeedModel const model(diameter, free, fixed);
    for (MeasuredSpeed const& one : speeds) model.check(one);
    return model;
}

}  // namespace vibrotrough::learn
