#include "learn/atlas_design_model.hpp"

#include "atlas/tables.hpp"
#include "atlas/value.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

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

    std::string title() const {
        return is_given ? name
                        : fmt::format("{} (not given: {:.3g} to {:.3g})", name, value.low(), value.high());
    }
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

/// An input that a design is free to choose, and how it is called in a sentence.
struct ChosenInput {
    atlas::Input input;
    char const* name;
    bool is_of_drive;
};
constexpr std::array chosen_inputs{
    ChosenInput{atlas::throw_number_input, "throw numbers", true},
    ChosenInput{atlas::tan_vibration_input, "tan(beta)", true},
    ChosenInput{atlas::tan_inclination_input, "tan(alpha)", true},
    ChosenInput{atlas::friction_input, "frictions", false},
    ChosenInput{atlas::amplitude_input, "amplitudes in diameters of a grain", true},
    ChosenInput{atlas::depth_input, "layer depths in diameters of a grain", false}};
constexpr double rounding = 1e-9;  // of the width of a range

/// By how much a place is beyond a range, relative to its width; at most zero inside.
double beyond(atlas::Input input, double value) {
    double const share = atlas::inputs()[input].share_of(value);
    return std::max(-share, share - 1);
}

theory::Range within(theory::Range const& space, theory::Range const& known, std::string_view what) {
    theory::Range const both{std::max(space.low, known.low), std::min(space.high, known.high)};
    if (both.low > both.high)
        throw std::invalid_argument(
            fmt::format("the atlas of simulated layers ends before the limits of the {}", what));
    return both;
}

class AtlasSpeeds : public SpeedModel {
  public:
    /// @param looked_at  friction at which it is looked at what the unknown inputs leave open
    AtlasSpeeds(std::vector<OpenInput> inputs, double diameter, double looked_at)
        : inputs_(std::move(inputs)), diameter_(diameter), looked_at_(looked_at) {}

    std::optional<ModelEfficiency> speed(DesignLayer const& layer, double friction,
                                         Precision precision) override {
        atlas::Place const place = place_of(layer.drive, layer.depth / diameter_, friction);
        bool const is_near = precision == Precision::near;
        auto const value = is_near ? atlas::near_value_at(place) : atlas::value_at(place);
        if (!value) return {};
        double const whole = value->half_width, numerics = atlas::numerical_error(place[atlas::depth_input]);
        double const statistics = std::sqrt(whole * whole - numerics * numerics);
        Spread const& open = spread(layer, is_near);
        return ModelEfficiency{value->efficiency,
                               std::hypot(statistics / atlas::deviations_in_half_width, open.sd),
                               numerics / atlas::deviations_in_half_width, open.sources};
    }

    std::optional<double> near_efficiency(DesignLayer const& layer, double friction) override {
        return atlas::near_efficiency_at(place_of(layer.drive, layer.depth / diameter_, friction));
    }

    Whereabouts where(theory::Drive const& drive, double friction,
                      std::optional<double> depth) const override {
        atlas::Place const place = place_of(drive, depth.value_or(1), friction);
        Whereabouts found;
        for (auto const& [input, name, is_of_drive] : chosen_inputs) {
            double const excess = beyond(input, place[input]);
            if (is_of_drive) found.excess = std::max(found.excess, excess);
            bool const is_known = input != atlas::depth_input || depth;
            if (found.why_not || !is_known || excess <= rounding) continue;
            found.why_not =
                fmt::format("the simulated layers of the atlas have {} of {:g} to {:g}, and not {:.3g}", name,
                            range_of(input).low, range_of(input).high, place[input]);
        }
        if (!found.why_not && depth)
            if (auto const all = atlas::outside_together(place); !all.empty())
                found.why_not =
                    "the atlas has no simulated layer with this slope and amplitude: " + all.front().why;
        return found;
    }

    void narrow(theory::DriveSpace& space, theory::Range& depth) const override {
        auto const [shallow, steep] = range_of(atlas::tan_vibration_input);
        auto const [down, up] = range_of(atlas::tan_inclination_input);
        auto const [small, large] = range_of(atlas::amplitude_input);
        auto const [thin, thick] = range_of(atlas::depth_input);
        space.vibration_angle =
            within(space.vibration_angle, {std::atan(shallow), std::atan(steep)}, "vibration angle");
        space.inclination = within(space.inclination, {std::atan(down), std::atan(up)}, "inclination");
        space.amplitude = within(space.amplitude, {small * diameter_, large * diameter_}, "stroke");
        space.max_throw_number = std::min(space.max_throw_number, range_of(atlas::throw_number_input).high);
        depth = {std::max(depth.low, thin * diameter_), std::min(depth.high, thick * diameter_)};
    }

  private:
    /// What the unknown inputs leave open at a place, each alone and all together.
    struct Spread {
        atlas::Place place;
        std::vector<OwnSource> sources;
        double sd = 0;
    };

    /// The place of a layer, with what is not exact at its mean. @param depth  in diameters
    atlas::Place place_of(theory::Drive const& d, double depth, double friction) const {
        atlas::Place place{d.throw_number(), std::tan(d.vibration_angle), std::tan(d.inclination),
                           friction,         d.amplitude / diameter_,     depth};
        place.resize(atlas::inputs().size());
        for (OpenInput const& one : inputs_) place[one.input] = one.value.mean;
        return place;
    }

    /// A design asks for many frictions at one layer.
    Spread const& spread(DesignLayer const& layer, bool is_near) {
        Spread& last = is_near ? last_near_ : last_exact_;
        atlas::Place place = place_of(layer.drive, layer.depth / diameter_, looked_at_);
        if (last.place == place) return last;
        last = {place, {}, 0};
        for (OpenInput const& one : inputs_) {
            if (one.value.sd <= 0) continue;
            double const sd = deviation_within(range_of(one.input), one.value, [&](double value) {
                place[one.input] = value;
                return is_near ? atlas::near_efficiency_at(place) : atlas::efficiency_at(place);
            });
            place[one.input] = one.value.mean;
            last.sources.push_back({one.title(), sd});
        }
        double squares = 0;
        for (OwnSource const& one : last.sources) squares += one.sd * one.sd;
        last.sd = std::sqrt(squares);
        return last;
    }

    std::vector<OpenInput> inputs_;
    double diameter_, looked_at_;
    Spread last_exact_, last_near_;
};

}  // namespace

DesignModel atlas_design_model(KnownGrains const& grains, double discrepancy, double friction) {
    auto const inputs = open_inputs(grains);
    for (OpenInput const& one : inputs) {
        if (beyond(one.input, one.value.mean) <= 0) continue;
        throw core::InputError(fmt::format("a {} of {:g} lies outside of the atlas, which has {:g} to {:g}",
                                           one.name, one.value.mean, range_of(one.input).low,
                                           range_of(one.input).high));
    }
    double const usual = friction > 0 ? friction : atlas::middle_of(atlas::friction_input);
    double const diameter = grains.diameter.value();
    auto const [gentle, vigorous] = range_of(atlas::throw_number_input);
    auto const [small, large] = range_of(atlas::amplitude_input);
    auto const [thin, thick] = range_of(atlas::depth_input);
    return {.name = "the atlas",
            .discrepancy = discrepancy,
            .speeds = std::make_shared<AtlasSpeeds>(inputs, diameter, usual),
            .known_range = fmt::format(
                "throw numbers of {:g} to {:g}, strokes of {:.3g} to {:.3g} mm and layers {:.3g} to "
                "{:.3g} mm deep",
                gentle, vigorous, 2e3 * small * diameter, 2e3 * large * diameter, 1e3 * thin * diameter,
                1e3 * thick * diameter),
            .is_slow = true};
}

}  // namespace vibrotrough::learn
