#include "learn/atlas_design_model.hpp"

#include "atlas/tables.hpp"
#include "atlas/unknown.hpp"
#include "atlas/value.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace vibrotrough::learn {
namespace {

theory::Range range_of(atlas::Input input) {
    return {atlas::inputs()[input].low, atlas::inputs()[input].high};
}

/// An input of the atlas that a design may not know.
struct OpenInput {
    atlas::Input input;
    char const* name;
    Uncertain value;
    bool is_given;
};

/// What is not known of the grains.
std::vector<OpenInput> open_inputs(KnownGrains const& grains) {
    auto const one = [&](atlas::Input input, char const* name, std::optional<Uncertain> const& given) {
        auto const [low, high] = range_of(input);
        return OpenInput{input, name, given.value_or(between_ends(low, high)), given.has_value()};
    };
    return {one(atlas::rolling_friction_input, "rolling friction", grains.rolling_friction),
            one(atlas::grain_friction_input, "friction between grains", grains.friction),
            one(atlas::restitution_input, "restitution", {})};
}

/// The place of a layer, with what is not exact at its mean.
atlas::Place place_of(DesignLayer const& layer, double mu, double diameter,
                      std::vector<OpenInput> const& inputs) {
    theory::Drive const& d = layer.drive;
    atlas::Place place(atlas::inputs().size());
    place[atlas::throw_number_input] = d.throw_number();
    place[atlas::tan_vibration_input] = std::tan(d.vibration_angle);
    place[atlas::tan_inclination_input] = std::tan(d.inclination);
    place[atlas::friction_input] = mu;
    place[atlas::amplitude_input] = d.amplitude / diameter;
    place[atlas::depth_input] = layer.depth / diameter;
    for (OpenInput const& one : inputs) place[one.input] = one.value.mean;
    return place;
}

/// An input that a design is free to choose, and how it is called in a sentence.
struct ChosenInput {
    atlas::Input input;
    char const* name;
};
constexpr std::array chosen_inputs{ChosenInput{atlas::throw_number_input, "throw numbers"},
                                   ChosenInput{atlas::tan_vibration_input, "tan(beta)"},
                                   ChosenInput{atlas::tan_inclination_input, "tan(alpha)"},
                                   ChosenInput{atlas::friction_input, "frictions"},
                                   ChosenInput{atlas::amplitude_input, "amplitudes in diameters of a grain"},
                                   ChosenInput{atlas::depth_input, "layer depths in diameters of a grain"}};
/// Those of the drive.
constexpr std::array inputs_of_drive{atlas::throw_number_input, atlas::tan_vibration_input,
                                     atlas::tan_inclination_input, atlas::amplitude_input};
constexpr double rounding = 1e-9;  // of the width of a range

/// By how much a place is beyond a range, relative to its width; at most zero inside.
double beyond(atlas::Input input, double value) {
    double const share = atlas::inputs()[input].share_of(value);
    return std::max(-share, share - 1);
}

using EfficiencyAt = std::function<std::optional<double>(atlas::Place const&)>;

/// Standard deviation of the efficiency when one input is not exact, within the range of the atlas.
double spread_by(OpenInput const& one, atlas::Place place, EfficiencyAt const& efficiency_at) {
    auto const [low, high] = range_of(one.input);
    return deviation_of(one.value, [&, low = low, high = high](double value) {
        place[one.input] = std::clamp(value, low, high);
        return efficiency_at(place);
    });
}

std::vector<OwnSource> sources_at(atlas::Place const& place, std::vector<OpenInput> const& inputs,
                                  EfficiencyAt const& efficiency_at) {
    std::vector<OwnSource> all;
    for (OpenInput const& one : inputs) {
        if (one.value.sd <= 0) continue;
        all.push_back({one.is_given ? one.name
                                    : fmt::format("{} (not given: {:.3g} to {:.3g})", one.name,
                                                  one.value.low(), one.value.high()),
                       spread_by(one, place, efficiency_at)});
    }
    return all;
}

/// What all of them together leave open.
double spread_at(atlas::Place const& place, std::vector<OpenInput> const& inputs,
                 EfficiencyAt const& efficiency_at) {
    double squares = 0;
    for (OwnSource const& one : sources_at(place, inputs, efficiency_at)) squares += one.sd * one.sd;
    return std::sqrt(squares);
}

std::optional<double> near_efficiency_at(atlas::Place const& place) {
    auto const value = atlas::near_value_at(place);
    return value ? std::optional(value->efficiency) : std::nullopt;
}

/// What the atlas says of layers of a material, by one of its two ways of saying it.
class AtlasAtLayers {
  public:
    using ValueAt = std::optional<atlas::SurfaceValue> (*)(atlas::Place const&);

    /// @param friction  at which it is looked at what the unknown inputs leave open
    AtlasAtLayers(std::vector<OpenInput> inputs, double diameter, double friction, ValueAt value_at,
                  EfficiencyAt efficiency_at)
        : inputs_(std::move(inputs)),
          diameter_(diameter),
          friction_(friction),
          value_at_(value_at),
          efficiency_at_(std::move(efficiency_at)) {}

    std::optional<ModelEfficiency> operator()(DesignLayer const& layer, double mu) {
        auto const value = value_at_(place_of(layer, mu, diameter_, inputs_));
        if (!value) return {};
        double const whole = value->half_width, numerics = atlas::numerical_error();
        double const statistics = std::sqrt(whole * whole - numerics * numerics);
        // A design asks for many frictions at one layer.
        if (auto const place = place_of(layer, friction_, diameter_, inputs_); last_place_ != place) {
            last_place_ = place;
            last_spread_ = spread_at(place, inputs_, efficiency_at_);
        }
        return ModelEfficiency{value->efficiency,
                               std::hypot(statistics / atlas::deviations_in_half_width, last_spread_),
                               numerics / atlas::deviations_in_half_width};
    }

  private:
    std::vector<OpenInput> inputs_;
    double diameter_, friction_;
    ValueAt value_at_;
    EfficiencyAt efficiency_at_;
    atlas::Place last_place_;
    double last_spread_ = 0;
};

/// Which of the numbers of a layer lies outside of the atlas, as a clause; nothing where all lie within.
std::optional<std::string> outside_atlas(atlas::Place const& place, bool is_depth_known) {
    for (auto const& [input, name] : chosen_inputs) {
        if (input == atlas::depth_input && !is_depth_known) continue;
        if (beyond(input, place[input]) > rounding)
            return fmt::format("the simulated layers of the atlas have {} of {:g} to {:g}, and not {:.3g}",
                               name, range_of(input).low, range_of(input).high, place[input]);
    }
    return {};
}

theory::Range within(theory::Range const& space, theory::Range const& known, std::string_view what) {
    theory::Range const both{std::max(space.low, known.low), std::min(space.high, known.high)};
    if (both.low > both.high)
        throw std::invalid_argument(
            fmt::format("the atlas of simulated layers ends before the limits of the {}", what));
    return both;
}

}  // namespace

DesignModel atlas_design_model(KnownGrains const& grains, double discrepancy, double friction) {
    auto const inputs = open_inputs(grains);
    for (OpenInput const& one : inputs) {
        if (beyond(one.input, one.value.mean) <= 0) continue;
        throw core::InputError(fmt::format("a {} of {:g} lies outside of the atlas, which has {:g} to {:g}",
                                           one.name, one.value.mean, range_of(one.input).low,
                                           range_of(one.input).high));
    }
    DesignModel model{.name = "the atlas", .discrepancy = discrepancy};
    double const usual = friction > 0 ? friction : atlas::middle_of(atlas::friction_input);
    double const diameter = grains.diameter;
    model.sources = [inputs, diameter, usual](DesignLayer const& layer) {
        return sources_at(place_of(layer, usual, diameter, inputs), inputs, atlas::efficiency_at);
    };
    auto const exact =
        std::make_shared<AtlasAtLayers>(inputs, diameter, usual, atlas::value_at, atlas::efficiency_at);
    auto const near =
        std::make_shared<AtlasAtLayers>(inputs, diameter, usual, atlas::near_value_at, near_efficiency_at);
    model.at = [exact](DesignLayer const& layer, double mu) { return (*exact)(layer, mu); };
    model.nearly_at = [near](DesignLayer const& layer, double mu) { return (*near)(layer, mu); };
    auto const [thin, thick] = range_of(atlas::depth_input);
    model.depths = {thin * diameter, thick * diameter};
    model.narrowed = [grains](theory::DriveSpace space) {
        auto const [shallow, steep] = range_of(atlas::tan_vibration_input);
        auto const [down, up] = range_of(atlas::tan_inclination_input);
        auto const [least, most] = range_of(atlas::amplitude_input);
        space.vibration_angle =
            within(space.vibration_angle, {std::atan(shallow), std::atan(steep)}, "vibration angle");
        space.inclination = within(space.inclination, {std::atan(down), std::atan(up)}, "inclination");
        space.amplitude =
            within(space.amplitude, {least * grains.diameter, most * grains.diameter}, "stroke");
        space.max_throw_number = std::min(space.max_throw_number, range_of(atlas::throw_number_input).high);
        return space;
    };
    auto const [gentle, vigorous] = range_of(atlas::throw_number_input);
    auto const [small, large] = range_of(atlas::amplitude_input);
    model.known_range = fmt::format(
        "throw numbers of {:g} to {:g}, strokes of {:.3g} to {:.3g} mm and layers {:.3g} to "
        "{:.3g} mm deep",
        gentle, vigorous, 2e3 * small * diameter, 2e3 * large * diameter, 1e3 * thin * diameter,
        1e3 * thick * diameter);
    model.excess = [inputs, diameter](theory::Drive const& d) {
        atlas::Place const place = place_of({d, 0}, 0, diameter, inputs);
        double most = -1;
        for (atlas::Input const input : inputs_of_drive) most = std::max(most, beyond(input, place[input]));
        return most;
    };
    model.outside = [inputs, diameter](theory::Drive const& d, double mu, std::optional<double> depth) {
        return outside_atlas(place_of({d, depth.value_or(0) * diameter}, mu, diameter, inputs),
                             depth.has_value());
    };
    return model;
}

}  // namespace vibrotrough::learn
