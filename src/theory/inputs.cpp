#include "theory/inputs.hpp"

#include "theory/detail/ranges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace vibrotrough::theory {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double zero_vibration_tangent = 1e-12;
constexpr double gravity = 9.81;  // m/s^2, as Machine::gravity

/// What people also write for an input.
struct OtherUnit {
    std::string_view name;
    InputColumn column;
};
constexpr std::array other_units{OtherUnit{"rpm", {Input::frequency_hz, 1.0 / 60}},
                                 OtherUnit{"amplitude_mm", {Input::amplitude_m, 1e-3}}};

// The ranges of the campaign file. A tangent has the same value after half a turn, where the trough would be
// upside down.
double tangent_of_inclination(double degrees) {
    detail::require_range(std::abs(degrees) <= 45, "inclination_deg", degrees, "[-45, 45]");
    return std::tan(degrees * degree);
}

double tangent_of_vibration_angle(double degrees) {
    detail::require_range(degrees >= 0 && degrees <= 89, "vibration_angle_deg", degrees, "[0, 89]");
    return std::tan(degrees * degree);
}

}  // namespace

std::optional<Input> input_named(std::string_view name) {
    // Not std::ranges, which the compiler of the page for browsers does not have whole.
    auto const* const row = std::find_if(input_rows.begin(), input_rows.end(),
                                         [&](InputRow const& one) { return one.name == name; });
    if (row == input_rows.end()) return std::nullopt;
    return static_cast<Input>(row - input_rows.begin());
}

std::optional<double> value_in(Conveyor const& conveyor, InputRow const& row) {
    if (auto const* const member = std::get_if<double Conveyor::*>(&row.member))
        return conveyor.**member / row.factor;
    if (auto const* const member = std::get_if<std::optional<double> Conveyor::*>(&row.member))
        return conveyor.**member;
    return std::nullopt;
}

std::optional<InputColumn> input_column_named(std::string_view name) {
    auto const other = std::find_if(other_units.begin(), other_units.end(),
                                    [&](OtherUnit const& other_unit) { return other_unit.name == name; });
    if (other != other_units.end()) return other->column;
    auto const input = input_named(name);
    return input ? std::optional(InputColumn{*input, 1}) : std::nullopt;
}

std::vector<std::string> input_column_names() {
    std::vector<std::string> all;
    for (InputRow const& row : input_rows) all.emplace_back(row.name);
    for (OtherUnit const& other : other_units) all.emplace_back(other.name);
    return all;
}

std::optional<std::string> Inputs::incomplete() const {
    auto const count = [&](Input a, Input b) { return (get(a) ? 1 : 0) + (get(b) ? 1 : 0); };
    auto const pair = [](Input a, Input b) {
        return std::string(name_of(a)) + " and " + std::string(name_of(b));
    };
    int const drive = count(Input::throw_number, Input::machine_number) + (get(Input::frequency_hz) ? 1 : 0);
    int const amplitudes = count(Input::amplitude_m, Input::stroke_mm);
    int const angle = count(Input::vibration_angle_deg, Input::tan_vibration_angle);
    int const slope = count(Input::inclination_deg, Input::tan_inclination);
    if (drive != 1) return "give exactly one of throw_number, machine_number and frequency_hz";
    if (amplitudes > 1) return "give the amplitude or the stroke, not both";
    if (get(Input::frequency_hz) && amplitudes == 0)
        return "frequency_hz also needs " + std::string(name_of(Input::amplitude_m)) + " or " +
               std::string(name_of(Input::stroke_mm));
    if (angle != 1)
        return "give exactly one of " + pair(Input::vibration_angle_deg, Input::tan_vibration_angle);
    if (slope > 1) return "give at most one of " + pair(Input::inclination_deg, Input::tan_inclination);
    if (!get(Input::friction)) return "friction is missing";
    return std::nullopt;
}

bool Inputs::plastic() const {
    for (std::size_t i = 0; i < input_count; ++i) {
        if (value_[i] && is_beyond_plastic(static_cast<Input>(i))) return false;
    }
    return true;
}

std::optional<double> Inputs::amplitude() const {
    if (auto const stroke = get(Input::stroke_mm)) return 1e-3 * *stroke / 2;
    return get(Input::amplitude_m);
}

std::optional<double> Inputs::velocity_scale() const {
    auto const r = amplitude();
    if (!r) return std::nullopt;
    PointMass const p = point();
    double const omega = std::sqrt(machine_number(p) * gravity / *r);
    return omega * *r / std::hypot(1, p.tan_vibration_angle);
}

PointMass Inputs::point() const {
    if (auto const problem = incomplete()) throw std::invalid_argument(*problem);
    if (auto const r = amplitude(); r && !(*r > 0))
        throw std::invalid_argument("the amplitude is not above 0");
    PointMass p{};
    p.friction = *get(Input::friction);
    if (auto const tan_alpha = get(Input::tan_inclination)) {
        detail::require_range(std::abs(*tan_alpha) <= 1, "tan_inclination", *tan_alpha, "[-1, 1]");
        p.tan_inclination = *tan_alpha;
    }
    if (auto const alpha = get(Input::inclination_deg)) p.tan_inclination = tangent_of_inclination(*alpha);
    if (auto const tan_beta = get(Input::tan_vibration_angle)) p.tan_vibration_angle = *tan_beta;
    if (auto const beta = get(Input::vibration_angle_deg))
        p.tan_vibration_angle = tangent_of_vibration_angle(*beta);
    if (auto const gamma = get(Input::throw_number)) {
        p.throw_number = *gamma;
    } else {
        double const omega = 2 * std::numbers::pi * get(Input::frequency_hz).value_or(0);
        double const k =
            get(Input::machine_number).value_or(omega * omega * amplitude().value_or(0) / gravity);
        if (p.tan_vibration_angle == 0) p.tan_vibration_angle = zero_vibration_tangent;
        double const a = p.tan_inclination, b = p.tan_vibration_angle;
        p.throw_number = k * b / std::sqrt(1 + b * b) * std::sqrt(1 + a * a);
    }
    return p;
}

Conveyor Inputs::conveyor() const {
    Conveyor c{};
    c.point = point();
    for (std::size_t i = 0; i < input_count; ++i) {
        if (!value_[i]) continue;
        double const value = *value_[i] * input_rows[i].factor;
        if (auto const* const member = std::get_if<double Conveyor::*>(&input_rows[i].member))
            c.** member = value;
        if (auto const* const member = std::get_if<std::optional<double> Conveyor::*>(&input_rows[i].member))
            c.** member = value;
    }
    return c;
}

}  // namespace vibrotrough::theory
