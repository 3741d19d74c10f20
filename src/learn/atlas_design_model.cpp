#include "learn/atlas_design_model.hpp"

#include "atlas/tables.hpp"
#include "atlas/unknown.hpp"
#include "atlas/value.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
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
    char const* why_open;  ///< when nobody gave it
};

/// Depth, which the mass flow decides, and the grains.
std::vector<OpenInput> open_inputs(KnownGrains const& grains) {
    auto const anything = [](atlas::Input input) {
        return between_ends(range_of(input).low, range_of(input).high);
    };
    auto const one = [&](atlas::Input input, char const* name, std::optional<Uncertain> const& given) {
        return OpenInput{input, name, given ? *given : anything(input), given ? nullptr : "not given"};
    };
    auto const depths = range_of(atlas::depth_input);
    Uncertain const depth =
        grains.depth ? Uncertain{std::clamp(*grains.depth / grains.diameter, depths.low, depths.high)}
                     : anything(atlas::depth_input);
    return {one(atlas::rolling_friction_input, "rolling friction", grains.rolling_friction),
            one(atlas::grain_friction_input, "friction between grains", grains.friction),
            one(atlas::restitution_input, "restitution", {}),
            {atlas::depth_input, "depth of the layer in diameters", depth, "atlas"}};
}

/// The place of a drive, with what is not exact at its mean.
atlas::Place place_of(theory::Drive const& d, double mu, double diameter,
                      std::vector<OpenInput> const& inputs) {
    atlas::Place place(atlas::inputs().size());
    place[atlas::throw_number_input] = d.throw_number();
    place[atlas::tan_vibration_input] = std::tan(d.vibration_angle);
    place[atlas::tan_inclination_input] = std::tan(d.inclination);
    place[atlas::friction_input] = mu;
    place[atlas::amplitude_input] = d.amplitude / diameter;
    for (OpenInput const& one : inputs) place[one.input] = one.value.mean;
    return place;
}

/// Inputs of the drive, which a design is free to choose.
constexpr std::array inputs_of_drive{atlas::throw_number_input, atlas::tan_vibration_input,
                                     atlas::tan_inclination_input, atlas::amplitude_input};
constexpr double rounding = 1e-9;  // of the width of a range

/// By how much a place is beyond a range, relative to its width; at most zero inside.
double beyond(atlas::Input input, double value) {
    double const share = atlas::inputs()[input].share_of(value);
    return std::max(-share, share - 1);
}

/// Standard deviation of the efficiency when one input is not exact, within the range of the atlas.
double spread_by(OpenInput const& one, atlas::Place place) {
    auto const [low, high] = range_of(one.input);
    return deviation_of(one.value, [&, low = low, high = high](double value) {
        place[one.input] = std::clamp(value, low, high);
        return atlas::efficiency_at(place);
    });
}

std::vector<OwnSource> sources_at(atlas::Place const& place, std::vector<OpenInput> const& inputs) {
    std::vector<OwnSource> all;
    for (OpenInput const& one : inputs) {
        if (one.value.sd <= 0) continue;
        all.push_back({one.why_open == nullptr ? one.name
                                               : fmt::format("{} ({}: {:.3g} to {:.3g})", one.name,
                                                             one.why_open, one.value.low(), one.value.high()),
                       spread_by(one, place)});
    }
    return all;
}

/// What all of them together leave open.
double spread_at(atlas::Place const& place, std::vector<OpenInput> const& inputs) {
    double squares = 0;
    for (OwnSource const& one : sources_at(place, inputs)) squares += one.sd * one.sd;
    return std::sqrt(squares);
}

theory::Range within(theory::Range const& space, theory::Range const& known, std::string_view what) {
    theory::Range const both{std::max(space.low, known.low), std::min(space.high, known.high)};
    if (both.low > both.high)
        throw core::InputError(
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
    DesignModel model{.name = "the atlas", .discrepancy = discrepancy, .is_slow = true};
    double const usual = friction > 0 ? friction : atlas::middle_of(atlas::friction_input);
    double const diameter = grains.diameter;
    model.sources = [inputs, diameter, usual](theory::Drive const& d) {
        return sources_at(place_of(d, usual, diameter, inputs), inputs);
    };
    // A design asks for many frictions at one drive.
    auto const last = std::make_shared<std::pair<atlas::Place, double>>();
    model.at = [inputs, diameter, usual, last](theory::Drive const& d,
                                               double mu) -> std::optional<ModelEfficiency> {
        auto const value = atlas::value_at(place_of(d, mu, diameter, inputs));
        if (!value) return {};
        double const whole = value->half_width, numerics = atlas::numerical_error();
        double const statistics = std::sqrt(whole * whole - numerics * numerics);
        if (atlas::Place const place = place_of(d, usual, diameter, inputs); last->first != place)
            *last = {place, spread_at(place, inputs)};
        return ModelEfficiency{value->efficiency,
                               std::hypot(statistics / atlas::deviations_in_half_width, last->second),
                               numerics / atlas::deviations_in_half_width};
    };
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
    model.known_range =
        fmt::format("throw numbers of {:g} to {:g} and strokes of {:.3g} to {:.3g} mm", gentle, vigorous,
                    2e3 * small * grains.diameter, 2e3 * large * grains.diameter);
    model.excess = [inputs, diameter](theory::Drive const& d) {
        atlas::Place const place = place_of(d, atlas::middle_of(atlas::friction_input), diameter, inputs);
        double most = -1;
        for (atlas::Input const input : inputs_of_drive) most = std::max(most, beyond(input, place[input]));
        return most;
    };
    model.outside = [](theory::Drive const&, double mu,
                       std::optional<double> deep) -> std::optional<std::string> {
        auto const tell = [](std::string_view what, atlas::Input input, double value) {
            return fmt::format("the atlas has a {} of {:g} to {:g}, and not {:.3g}", what,
                               range_of(input).low, range_of(input).high, value);
        };
        if (beyond(atlas::friction_input, mu) > rounding) return tell("friction", atlas::friction_input, mu);
        if (deep && beyond(atlas::depth_input, *deep) > rounding)
            return tell("depth in diameters", atlas::depth_input, *deep);
        return {};
    };
    model.with_depth = [grains, discrepancy, friction](double depth) {
        KnownGrains layer = grains;
        layer.depth = depth;
        return atlas_design_model(layer, discrepancy, friction);
    };
    return model;
}

}  // namespace vibrotrough::learn
