#include "learn/atlas_speed_model.hpp"

#include "atlas/atlas.hpp"
#include "atlas/tables.hpp"
#include "core/error.hpp"
#include "learn/corrected_model.hpp"
#include "learn/given_quantities.hpp"
#include "learn/machine_keys.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::learn {
namespace {

/// The properties of the layer, in the order of atlas_parameters().
enum Quantity : std::size_t { friction, grain_friction, rolling_friction, restitution, depth };

inference::Bounds bounds_of(atlas::Input input) {
    return {atlas::inputs()[input].low, atlas::inputs()[input].high};
}

inference::Bounds degrees_of(atlas::Input tangent) {
    auto const [low, high] = bounds_of(tangent);
    return {std::atan(low) / degree, std::atan(high) / degree};
}

class AtlasSpeedModel {
  public:
    AtlasSpeedModel(double diameter, GivenQuantities given) : diameter_(diameter), given_(std::move(given)) {}

    std::optional<ModelSpeed> operator()(std::span<double const> values,
                                         MeasuredSpeed const& measured) const {
        GivenQuantities::Values const all = given_.at(values);
        theory::Drive const drive = given_.drive(all, measured);
        atlas::Place const place = place_of(all, drive);
        if (!atlas::outside_ranges(place).empty()) return {};
        auto const answer = atlas::value_at(place);
        if (!answer) return {};
        double const trough_speed = drive.trough_speed();
        double const numerics =
            atlas::numerical_error(place[atlas::depth_input]) / atlas::deviations_in_half_width;
        double const whole = answer->half_width / atlas::deviations_in_half_width;
        double const statistics = whole * whole - numerics * numerics;
        double const common = common_share * statistics + numerics * numerics;
        return ModelSpeed{answer->efficiency * trough_speed,
                          std::sqrt((1 - common_share) * statistics) * trough_speed, trough_speed,
                          std::sqrt(common) * trough_speed};
    }

    /// @param middle  of the free quantities
    /// @throws core::InputError when the atlas lacks a measurement, whatever the free quantities are
    void check(MeasuredSpeed const& measured, std::span<double const> middle) const {
        GivenQuantities::Values const all = given_.at(middle);
        // A free angle moves the throw number.
        bool const may_move = given_.is_free("vibration_angle") || given_.is_free("inclination");
        for (atlas::Outside const& one : atlas::outside_ranges(place_of(all, given_.drive(all, measured)))) {
            if (may_move && one.name == atlas::inputs()[atlas::throw_number_input].key) continue;
            throw core::InputError(
                fmt::format("line {}: outside of the atlas: {}; leave the line out, or use the point mass",
                            measured.line, one.why));
        }
    }

  private:
    atlas::Place place_of(GivenQuantities::Values const& all, theory::Drive const& drive) const {
        return {drive.throw_number(), std::tan(drive.vibration_angle), std::tan(drive.inclination),
                *all[friction],       drive.amplitude / diameter_,     *all[depth],
                *all[grain_friction], *all[rolling_friction],          *all[restitution]};
    }

    double diameter_;
    GivenQuantities given_;
};

FreeParameter const& parameter(std::string const& name) {
    return *std::ranges::find(atlas_parameters(), name, &FreeParameter::name);
}

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
    GivenQuantities const given(free, fixed, atlas_parameters(), "a layer of spheres", speeds);
    for (auto const& [name, value] : fixed) {
        auto const [low, high] = parameter(name).prior;
        if (value < low || value > high)
            throw core::InputError(
                fmt::format("--fix {}={:g}: the atlas has {:.3g} to {:.3g}", name, value, low, high));
    }
    std::vector<double> middle;
    for (std::string const& name : free)
        middle.push_back((parameter(name).prior.low + parameter(name).prior.high) / 2);
    AtlasSpeedModel const model(diameter, given);
    for (MeasuredSpeed const& one : speeds) model.check(one, middle);
    return model;
}

}  // namespace vibrotrough::learn
