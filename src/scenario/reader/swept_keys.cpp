#include "scenario/reader/swept_keys.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

using Result = std::optional<Content>;

/// A key and the function that takes its value from a scenario.
struct KeyValue {
    std::string_view path;
    Result (*of)(Scenario const&);
};

Result optional_number(std::optional<double> const& value) {
    if (!value) return {};
    return Content(*value);
}

Result text(std::string_view word) {
    return Content(std::string(word));
}

Result whole(int number) {
    return Content(static_cast<double>(number));
}

constexpr std::array trough_values{
    KeyValue{"trough.inclination", [](Scenario const& s) -> Result { return s.trough.inclination; }},
    KeyValue{"trough.tan_inclination",
             [](Scenario const& s) -> Result {
                 return s.trough.given.tan_inclination.value_or(std::tan(s.trough.inclination));
             }},
    KeyValue{"trough.vibration_angle", [](Scenario const& s) -> Result { return s.trough.vibration_angle; }},
    KeyValue{"trough.tan_vibration_angle",
             [](Scenario const& s) -> Result {
                 return s.trough.given.tan_vibration_angle.value_or(std::tan(s.trough.vibration_angle));
             }},
    KeyValue{"trough.amplitude", [](Scenario const& s) -> Result { return s.trough.amplitude; }},
    KeyValue{"trough.stroke", [](Scenario const& s) -> Result { return 2 * s.trough.amplitude; }},
    KeyValue{"trough.throw_number", [](Scenario const& s) -> Result { return throw_number(s.trough); }},
    KeyValue{"trough.machine_number", [](Scenario const& s) -> Result { return machine_number(s.trough); }},
    KeyValue{"trough.frequency", [](Scenario const& s) -> Result { return s.trough.frequency; }},
    KeyValue{"trough.friction", [](Scenario const& s) -> Result { return s.trough.friction; }},
    KeyValue{"trough.restitution", [](Scenario const& s) -> Result { return s.trough.restitution; }},
    KeyValue{"trough.side_wall_friction",
             [](Scenario const& s) { return optional_number(s.trough.side_wall_friction); }},
    KeyValue{"trough.along_phase", [](Scenario const& s) -> Result { return s.trough.along_phase; }},
    KeyValue{"trough.waveform",
             [](Scenario const& s) {
                 return s.trough.waveform ? text(s.trough.waveform->file.name) : std::nullopt;
             }},
    KeyValue{"trough.width", [](Scenario const& s) { return optional_number(trough_width(s)); }},
};

constexpr std::array layer_values{
    KeyValue{"grains.diameter", [](Scenario const& s) -> Result { return s.grains.diameter; }},
    KeyValue{"grains.diameter_spread", [](Scenario const& s) -> Result { return s.grains.diameter_spread; }},
    KeyValue{"grains.size_law", [](Scenario const& s) { return text(name_of(s.grains.size_law)); }},
    KeyValue{"grains.density", [](Scenario const& s) -> Result { return s.grains.density; }},
    KeyValue{"grains.bulk_density", [](Scenario const& s) -> Result { return bulk_density(s.grains); }},
    KeyValue{"grains.youngs_modulus",
             [](Scenario const& s) { return optional_number(s.grains.youngs_modulus); }},
    KeyValue{"grains.poisson_ratio", [](Scenario const& s) -> Result { return s.grains.poisson_ratio; }},
    KeyValue{"grains.friction", [](Scenario const& s) -> Result { return s.grains.friction; }},
    KeyValue{"grains.restitution", [](Scenario const& s) -> Result { return s.grains.restitution; }},
    KeyValue{"grains.rotation", [](Scenario const& s) { return text(name_of(s.grains.rotation)); }},
    KeyValue{"grains.rolling_friction",
             [](Scenario const& s) -> Result { return s.grains.rolling_friction; }},
    KeyValue{"grains.shape", [](Scenario const& s) { return text(s.grains.shape); }},
    KeyValue{"layer.length", [](Scenario const& s) -> Result { return s.layer.length; }},
    KeyValue{"layer.width", [](Scenario const& s) -> Result { return s.layer.width; }},
    KeyValue{"layer.height", [](Scenario const& s) -> Result { return layer_height(s); }},
    KeyValue{"layer.grains", [](Scenario const& s) { return whole(s.layer.grains); }},
    KeyValue{"layer.block", [](Scenario const& s) { return text(name_of(s.layer.block)); }},
};

constexpr std::array plan_values{
    KeyValue{"measure.packings", [](Scenario const& s) { return whole(s.measure.packings); }},
    KeyValue{"measure.max_packings", [](Scenario const& s) { return whole(s.measure.max_packings); }},
    KeyValue{"measure.max_core_time",
             [](Scenario const& s) { return optional_number(s.measure.max_core_time); }},
    KeyValue{"measure.confidence", [](Scenario const& s) -> Result { return s.measure.confidence; }},
    KeyValue{"measure.half_width", [](Scenario const& s) -> Result { return s.measure.half_width; }},
    KeyValue{"measure.max_cycles", [](Scenario const& s) { return whole(s.measure.max_cycles); }},
    KeyValue{"output.frames_per_cycle", [](Scenario const& s) { return whole(s.output.frames_per_cycle); }},
    KeyValue{"output.checkpoint_cycles", [](Scenario const& s) { return whole(s.output.checkpoint_cycles); }},
    KeyValue{"solver.rayleigh_fraction",
             [](Scenario const& s) -> Result { return s.solver.rayleigh_fraction; }},
    KeyValue{"solver.block_stiffness", [](Scenario const& s) -> Result { return s.solver.block_stiffness; }},
    KeyValue{"engine.contact", [](Scenario const& s) { return text(name_of(s.engine.contact)); }},
    KeyValue{"engine.cohesion", [](Scenario const& s) -> Result { return s.engine.cohesion; }},
    KeyValue{"engine.extra",
             [](Scenario const& s) { return text(s.engine.extra ? s.engine.extra->file.name : "none"); }},
};

bool differs(std::string_view path, std::vector<Scenario> const& cases) {
    return std::ranges::any_of(
        cases, [&](Scenario const& one) { return key_value(one, path) != key_value(cases.front(), path); });
}

}  // namespace

std::optional<Content> key_value(Scenario const& scenario, std::string_view path) {
    for (std::span<KeyValue const> const part :
         {std::span<KeyValue const>(trough_values), std::span<KeyValue const>(layer_values),
          std::span<KeyValue const>(plan_values)}) {
        auto const found = std::ranges::find(part, path, &KeyValue::path);
        if (found != part.end()) return found->of(scenario);
    }
    return {};
}

SweptKeys swept_keys(std::vector<Key const*> const& candidates, std::vector<Scenario> const& cases) {
    SweptKeys swept;
    for (Key const* const key : candidates) {
        if (std::ranges::find(swept, key) == swept.end() && differs(key->path, cases)) swept.push_back(key);
    }
    return swept;
}

ShownUnit shown_unit(Key const& key) {
    if (key.unit == "m") return {1e3, "mm"};
    if (key.unit == "radian") return {180 / std::numbers::pi, "deg"};
    if (key.unit == "Pa") return {1e-6, "MPa"};
    return {1, key.unit};
}

std::string written_value(Key const& key, Content const& value) {
    if (auto const* const word = std::get_if<std::string>(&value)) return *word;
    auto const* const number = std::get_if<double>(&value);
    if (number == nullptr) return "";
    ShownUnit const unit = shown_unit(key);
    double const shown = key.unit == "radian" ? in_degrees(*number) : unit.factor * *number;
    return fmt::format("{:.6g}{}{}", shown, unit.name.empty() ? "" : " ", unit.name);
}

std::string_view short_name(Key const& key) {
    return key.path.starts_with("trough.") ? key.path.substr(key.path.find('.') + 1) : key.path;
}

std::string swept_label(Scenario const& scenario, std::span<Key const* const> keys) {
    std::string label;
    for (Key const* const key : keys) {
        auto const value = key_value(scenario, key->path);
        label += fmt::format("{}{} {}", label.empty() ? "" : ", ", short_name(*key),
                             value ? written_value(*key, *value) : "none");
    }
    return label;
}

}  // namespace vibrotrough::scenario
