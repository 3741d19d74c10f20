#include "learn/atlas_design_model.hpp"

#include "atlas/tables.hpp"
#include "atlas/unknown.hpp"
#include "atlas/value.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace vibrotrough::learn {
namespace {

/// What of a layer a design does not know: its depth, which the mass flow decides, and the grains.
constexpr std::array<atlas::Input, 4> unknown{atlas::depth_input, atlas::grain_friction_input,
                                              atlas::rolling_friction_input, atlas::restitution_input};

theory::Range range_of(atlas::Input input) {
    return {atlas::inputs()[input].low, atlas::inputs()[input].high};
}

/// The place of a drive, with what is not known in the middle of the atlas.
atlas::Place place_of(theory::Drive const& d, double mu, KnownGrains const& grains) {
    return {d.throw_number(),
            std::tan(d.vibration_angle),
            std::tan(d.inclination),
            mu,
            d.amplitude / grains.diameter,
            atlas::middle_of(atlas::depth_input),
            atlas::middle_of(atlas::grain_friction_input),
            grains.rolling_friction.value_or(atlas::middle_of(atlas::rolling_friction_input)),
            atlas::middle_of(atlas::restitution_input)};
}

/// By how much a place is beyond a range, relative to its width; at most zero inside.
double beyond(atlas::Input input, double value) {
    auto const [low, high] = range_of(input);
    return std::max(low - value, value - high) / (high - low);
}

/// Standard deviation, in velocity efficiency, of what is not known.
double spread_of(KnownGrains const& grains) {
    if (!grains.rolling_friction) return atlas::sd_of_unknown(unknown);
    return atlas::sd_of_unknown(unknown, std::pair{atlas::rolling_friction_input, *grains.rolling_friction});
}

theory::Range within(theory::Range const& space, theory::Range const& known, std::string_view what) {
    theory::Range const both{std::max(space.low, known.low), std::min(space.high, known.high)};
    if (both.low > both.high)
        throw core::InputError(
            fmt::format("the atlas of simulated layers ends before the limits of the {}", what));
    return both;
}

}  // namespace

DesignModel atlas_design_model(KnownGrains const& grains, double discrepancy) {
    if (grains.rolling_friction && beyond(atlas::rolling_friction_input, *grains.rolling_friction) > 0) {
        throw core::InputError(
            fmt::format("a rolling friction of {:g} lies outside of the atlas, which has {:g} to {:g}",
                        *grains.rolling_friction, range_of(atlas::rolling_friction_input).low,
                        range_of(atlas::rolling_friction_input).high));
    }
    DesignModel model{.name = "the atlas", .discrepancy = discrepancy, .is_slow = true};
    model.at = [grains, spread = spread_of(grains)](theory::Drive const& d,
                                                    double mu) -> std::optional<ModelEfficiency> {
        auto const value = atlas::value_at(place_of(d, mu, grains));
        if (!value) return {};
        double const whole = value->half_width, numerics = atlas::numerical_error();
        double const statistics = std::sqrt(whole * whole - numerics * numerics);
        return ModelEfficiency{value->efficiency,
                               std::hypot(statistics / atlas::deviations_in_half_width, spread),
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
    model.excess = [grains](theory::Drive const& d) {
        atlas::Place const place = place_of(d, atlas::middle_of(atlas::friction_input), grains);
        double most = -1;
        for (std::size_t input = 0; input < place.size(); ++input)
            most = std::max(most, beyond(static_cast<atlas::Input>(input), place[input]));
        return most;
    };
    model.outside = [](theory::Drive const&, double mu,
                       std::optional<double> deep) -> std::optional<std::string> {
        auto const tell = [](std::string_view what, atlas::Input input, double value) {
            return fmt::format("the atlas has a {} of {:g} to {:g}, and not {:.3g}", what,
                               range_of(input).low, range_of(input).high, value);
        };
        if (beyond(atlas::friction_input, mu) > 0) return tell("friction", atlas::friction_input, mu);
        if (deep && beyond(atlas::depth_input, *deep) > 0)
            return tell("depth in diameters", atlas::depth_input, *deep);
        return {};
    };
    return model;
}

}  // namespace vibrotrough::learn
