#include "core/error.hpp"
#include "core/text.hpp"
#include "learn/design_details.hpp"
#include "learn/driven_design.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::learn {
namespace {

using Json = nlohmann::ordered_json;

char const* source_of(AddedMassSource source) {
    static constexpr std::array names{"as makers count", "as given", "the atlas of layers"};
    return names.at(static_cast<std::size_t>(source));
}

/// Whether a magnet has this frequency (Hz) on the mains without a controller: half of theirs, theirs or
/// twice.
bool is_of_mains(double frequency) {
    return std::ranges::any_of(std::array{25, 50, 100, 30, 60, 120},
                               [&](double one) { return std::abs(frequency / one - 1) < 0.01; });
}

/// The exciter of a machine under its layer.
struct ExcitedMachine {
    Exciter exciter;
    double material;                     ///< kg
    double empty;                        ///< m, amplitude without material
    double usual_power;                  ///< W
    std::optional<ChosenMotors> motors;  ///< none where another drive was asked for, or none is large enough
    std::optional<Suspension> suspension;  ///< none without springs
    std::string why_no_suspension = {};    ///< where springs do not isolate
};

/// Whether unbalance motors may drive the machine.
bool has_motors(DesignTask const& t) {
    return !t.drive_kind || t.drive_kind->name == "unbalance motors";
}

ExcitedMachine excited(DesignTask const& t, RiskDesign const& d) {
    double const f = d.drive.frequency, material = material_on(t, d.depth);
    MovedMachine machine = *t.machine;
    try {
        if (!machine.exciter) machine.exciter = exciter_needed(machine, f, material, d.drive.amplitude);
    } catch (std::invalid_argument const& error) {
        throw core::InputError(
            fmt::format("--spring: {}; write softer springs, or another --rpm", error.what()));
    }
    ExcitedMachine found{*machine.exciter,
                         material,
                         amplitude_of(machine, f, 0),
                         usual_drive_power(machine.moving_mass(material), d.drive.amplitude, f),
                         {},
                         {}};
    if (has_motors(t)) found.motors = choose_motors(machine.motors, machine.exciter->static_moment, f);
    if (machine.spring <= 0) return found;
    try {
        found.suspension = suspension_of(machine, f, material, d.drive.amplitude);
    } catch (std::invalid_argument const& error) {
        found.why_no_suspension = error.what();
    }
    return found;
}

/// "2 x 10 kN at 78 %", and what else a person orders of motors.
std::string motors_line(ChosenMotors const& m) {
    return fmt::format("2 x {:g} kN at {:.0f} %", 1e-3 * m.motor.force, 100 * m.setting);
}

std::string motors_text(DesignTask const& t, ExcitedMachine const& m) {
    if (!has_motors(t))
        return t.drive_kind->name == "crank" ? fmt::format(
                                                   "drive power       makers of crank drives install {} W "
                                                   "for the moved mass (F A omega "
                                                   "/ sqrt 2, ROSTA)\n",
                                                   core::plain_number(m.usual_power, 2))
                                             : "";
    if (!m.motors)
        return "motors            no pair of unbalance motors in the table is large enough; use more pairs, "
               "or a "
               "table of your own (--motors)\n";
    Motor const& one = m.motors->motor;
    return fmt::format(
        "motors            {} of {:g} 1/min ({:.4g} kg mm each at 100 %), {:.2g} kW installed each{}\n",
        motors_line(*m.motors), one.rpm, 1e3 * one.static_moment, 1e-3 * one.power,
        m.motors->is_converted ? ", from a frequency converter" : "");
}

std::string springs_text(ExcitedMachine const& m) {
    if (!m.why_no_suspension.empty()) return "springs           " + m.why_no_suspension + "\n";
    if (!m.suspension) return "";
    Suspension const& s = *m.suspension;
    return fmt::format(
        "springs           sag {:.0f} mm; natural frequency {:.3g} Hz empty, {:.3g} Hz loaded; isolation "
        "{:.0f} %\n"
        "on the building   {} N (amplitude of all springs together, k r)\n"
        "at the resonance  up to {:.2g} times the working stroke at a start in {:g} s, {:.2g} times when it "
        "runs out "
        "in {:g} s, without damping\n",
        1e3 * s.sag, s.empty, s.loaded, 100 * s.isolation, core::plain_number(s.force, 2), s.at_start,
        usual_start, s.at_stop, usual_stop);
}

/// One line, where the atlas knows the damping of the layer.
std::string damping_text(MovedMachine const& machine) {
    if (!machine.damping) return "";
    return fmt::format(
        "damping           of the layer: {:.3g} of its mass times omega (the atlas of layers)\n",
        machine.damping->mean);
}

Json motors_json(ExcitedMachine const& m) {
    if (!m.motors) return nullptr;
    Motor const& one = m.motors->motor;
    return {{"text", motors_line(*m.motors)},
            {"count", 2},
            {"rpm", one.rpm},
            {"force_n", one.force},
            {"static_moment_kg_m", one.static_moment},
            {"power_w", one.power},
            {"setting", m.motors->setting},
            {"frequency_converter", m.motors->is_converted}};
}

Json springs_json(ExcitedMachine const& m) {
    if (!m.suspension) return nullptr;
    Suspension const& s = *m.suspension;
    return {{"sag_mm", 1e3 * s.sag},
            {"natural_frequency_empty_hz", s.empty},
            {"natural_frequency_loaded_hz", s.loaded},
            {"isolation", s.isolation},
            {"force_on_building_n", s.force},
            {"stroke_ratio_at_start", s.at_start},
            {"stroke_ratio_at_stop", s.at_stop}};
}

}  // namespace

std::string exciter_text(DesignTask const& t, RiskDesign const& d) {
    if (!t.machine) return "";
    ExcitedMachine const m = excited(t, d);
    double const moment = m.exciter.static_moment;
    std::string text = fmt::format(
        "exciter           static moment {:.4g} kg mm (working moment {:.4g} cm kg), {:.3g} kN, all motors "
        "together{}\n",
        1e3 * moment, 200 * moment, 1e-3 * force_of(m.exciter, d.drive.frequency),
        t.machine->exciter ? "" : ": what this stroke needs");
    text += fmt::format(
        "stroke when empty {:.4g} mm; {:.3g} kg of material are on the trough, and {:.3g} % of it move "
        "along ({})\n{}",
        2e3 * m.empty, m.material, 100 * t.machine->added_mass.mean, source_of(t.machine->added_mass_source),
        damping_text(*t.machine));
    return text + motors_text(t, m) + springs_text(m);
}

Json exciter_json(DesignTask const& t, RiskDesign const& d) {
    if (!t.machine) return nullptr;
    ExcitedMachine const m = excited(t, d);
    return {{"is_given", t.machine->exciter.has_value()},
            {"static_moment_kg_m", m.exciter.static_moment},
            {"centrifugal_force_n", force_of(m.exciter, d.drive.frequency)},
            {"trough_mass_kg", t.machine->mass},
            {"moving_mass_kg", t.machine->moving_mass(m.material)},
            {"material_kg", m.material},
            {"added_mass_fraction", t.machine->added_mass.mean},
            {"added_mass_from", source_of(t.machine->added_mass_source)},
            {"damping", t.machine->damping ? Json(t.machine->damping->mean) : Json(nullptr)},
            {"stroke_empty_mm", 2e3 * m.empty},
            {"resonance_rpm", 60 * resonance_of(*t.machine, m.material)},
            {"usual_drive_power_w", m.usual_power},
            {"motors", motors_json(m)},
            {"springs", springs_json(m)}};
}

std::optional<double> depth_at(DesignTask const& t, RiskDesign const& d, double mass_flow) {
    constexpr int rounds = 20;
    constexpr double close = 1e-4;  // relative
    ModelForecast const& answer = d.forecasts.front();
    // Where another model stands in, the first one does not know the layer.
    auto const found = std::ranges::find(t.models, answer.model, &DesignModel::name);
    DesignModel const* const model = found != t.models.end()                          ? &*found
                                     : t.stand_in && t.stand_in->name == answer.model ? &*t.stand_in
                                                                                      : nullptr;
    double depth = d.depth * mass_flow / t.mass_flow;
    for (int i = 0; i < rounds; ++i) {
        auto const value = model ? model->at({d.drive, depth}, t.friction.median) : std::nullopt;
        double const speed =
            value && value->efficiency > 0 ? value->efficiency * d.drive.trough_speed() : answer.median_speed;
        double const next =
            std::clamp(mass_flow / (t.bulk_density * t.width * speed), d.depth / 10, 10 * d.depth);
        if (std::abs(next / depth - 1) < close) break;
        depth = (depth + next) / 2;
    }
    if (!(depth > 0 && depth <= std::max(d.depth, t.depth.high))) return {};
    return depth;
}

double side_wall(double depth) {
    constexpr double least_freeboard = 0.05, step = 0.01;  // m
    return std::ceil((depth + std::max(least_freeboard, depth / 2)) / step - 1e-6) * step;
}

std::string drive_text(DesignTask const& t, RiskDesign const& d) {
    std::string usual;
    for (DriveKind const& one : t.drive_kinds)
        if (one.builds(d.drive)) usual += (usual.empty() ? "" : " or ") + one.name;
    if (t.drive_kind) usual = t.drive_kind->builds(d.drive) ? t.drive_kind->name : "";
    std::string const others =
        t.drive_kind
            ? "the usual limits of " + t.drive_kind->name
            : "the usual limits of unbalance motors, cranks and magnets; --drive keeps to those of one";
    if (!t.drive_kind && t.drive_kinds.empty()) return "";
    if (usual == "magnet" && !is_of_mains(d.drive.frequency))
        usual += fmt::format(", with a controller for {:.3g} Hz (mains of 50 Hz alone give 25, 50 or 100 Hz)",
                             d.drive.frequency);
    return fmt::format("kind of drive     {}\n", usual.empty() ? "outside of " + others : usual);
}

}  // namespace vibrotrough::learn
