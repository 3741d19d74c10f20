#include "scenario/case_values.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace vibrotrough {
namespace {

/// Solid fraction of a settled layer whose height is twice the height of its centre of mass; measured on
/// settled packings of 3 mm spheres with friction 0.5 (tests/end_to_end), 0.58 within 0.02.
constexpr double settled_solid_fraction = 0.58;

class CaseBuilder {
  public:
    CaseBuilder(CaseValues const& values, std::string const& file) : values_(values), file_(file) {}

    Scenario build(std::string const& campaign) const {
        return {campaign, trough(), grains(), layer(), measure(), {integer("output.frames_per_cycle")}};
    }

  private:
    Value const* find(std::string_view key) const {
        auto const found = values_.find(key);
        return found == values_.end() ? nullptr : &found->second;
    }
    double number(std::string_view key) const {
        if (Value const* value = find(key)) return value->number;
        return find_key(key)->fallback.value();
    }
    int integer(std::string_view key) const { return static_cast<int>(std::lround(number(key))); }
    [[noreturn]] void fail(std::string_view key, std::string_view wrong, std::string_view instead) const {
        Value const* const value = find(key);
        throw_at({file_, value ? value->where : Position{}}, key, wrong, instead);
    }

    double angle(std::string_view angle_key, std::string_view tangent_key) const {
        if (Value const* value = find(angle_key)) return value->number;
        return std::atan(number(tangent_key));
    }

    double frequency(Trough const& trough) const {
        if (Value const* value = find("trough.frequency")) return value->number;
        double machine_number = 0;
        if (Value const* value = find("trough.machine_number")) {
            machine_number = value->number;
        } else {
            if (trough.vibration_angle <= 0) {
                fail("trough.throw_number",
                     "a trough that shakes along itself (vibration angle 0) has throw number 0",
                     "write machine_number or frequency instead");
            }
            machine_number = number("trough.throw_number") * std::cos(trough.inclination) /
                             std::sin(trough.vibration_angle);
        }
        double const result = std::sqrt(machine_number * gravity / trough.amplitude) / (2 * std::numbers::pi);
        Key const& key = *find_key("trough.frequency");
        if (result < key.least || result > key.most) {
            fail("trough.amplitude",
                 fmt::format("the drive would run at {:.4g} Hz, outside {}", result, key.range),
                 "change the amplitude or the throw number");
        }
        return result;
    }

    /// Throw and machine number follow from the frequency, or from each other; their upper bounds hold all
    /// the same.
    void check_derived(std::string_view path, double value) const {
        Key const& key = *find_key(path);
        if (value <= key.most * (1 + 1e-12)) return;
        for (std::string_view const given :
             {"trough.frequency", "trough.machine_number", "trough.throw_number"}) {
            if (find(given) == nullptr) continue;
            fail(given, fmt::format("makes the {} {:.4g}, outside {}", path.substr(7), value, key.range),
                 "lower it, or the amplitude");
        }
    }

    Trough trough() const {
        Trough trough{angle("trough.inclination", "trough.tan_inclination"),
                      angle("trough.vibration_angle", "trough.tan_vibration_angle"),
                      number("trough.amplitude"),
                      0,
                      number("trough.friction"),
                      number("trough.restitution")};
        trough.frequency = frequency(trough);
        check_derived("trough.throw_number", throw_number(trough));
        check_derived("trough.machine_number", machine_number(trough));
        return trough;
    }

    Grains grains() const {
        return {number("grains.diameter"),       number("grains.diameter_spread"), number("grains.density"),
                number("grains.youngs_modulus"), number("grains.poisson_ratio"),   number("grains.friction"),
                number("grains.restitution"),    number("grains.rolling_friction")};
    }

    Layer layer() const {
        double const largest = number("grains.diameter") * (1 + number("grains.diameter_spread"));
        for (char const* key : {"layer.length", "layer.width"}) {
            if (number(key) < 4 * largest) {
                fail(
                    key,
                    fmt::format(
                        "{:.6g} m is less than 4 of the largest grains ({:.6g} m), so that grains would meet "
                        "their own images",
                        number(key), largest),
                    fmt::format("write at least \"{:.6g} mm\"", 4e3 * largest));
            }
        }
        Layer layer{number("layer.length"), number("layer.width"), {}, 0};
        if (Value const* grains = find("layer.grains")) {
            layer.grains = static_cast<int>(std::lround(grains->number));
            return layer;
        }
        layer.height = number("layer.height");
        layer.grains = grains_for(*layer.height, layer);
        return layer;
    }

    int grains_for(double height, Layer const& layer) const {
        double const diameter = number("grains.diameter");
        double const spread = number("grains.diameter_spread");
        if (height < diameter) {
            fail("layer.height", fmt::format("{:.6g} m is less than one grain diameter", height),
                 fmt::format("write at least \"{:.6g} mm\"", 1e3 * diameter));
        }
        // Mean volume of classes 1 - s, 1, 1 + s in equal numbers: pi d^3 / 6 (1 + 2 s^2).
        double const volume = std::numbers::pi / 6 * std::pow(diameter, 3) * (1 + 2 * spread * spread);
        double const count = settled_solid_fraction * layer.length * layer.width * height / volume;
        Key const& key = *find_key("layer.grains");
        if (count > key.most) {
            fail("layer.height",
                 fmt::format("the layer would need {:.3g} grains, more than {:.0f}", count, key.most),
                 "make the layer smaller or the grains larger");
        }
        return std::max(1, static_cast<int>(std::lround(count)));
    }

    MeasurementPlan measure() const {
        return {integer("measure.packings"), number("measure.confidence"), number("measure.half_width"),
                integer("measure.max_cycles")};
    }

    CaseValues const& values_;
    std::string const& file_;
};

}  // namespace

void throw_at(Place place, std::string_view key, std::string_view wrong, std::string_view instead) {
    throw InputError(fmt::format("{}:{}:{}: {}: {}; {}", place.file, place.where.line, place.where.column,
                                 key, wrong, instead));
}

Scenario make_scenario(std::string const& campaign, CaseValues const& values, std::string const& file) {
    return CaseBuilder(values, file).build(campaign);
}

}  // namespace vibrotrough
