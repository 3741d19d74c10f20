#include "learn/design_details.hpp"

#include "core/text.hpp"
#include "learn/driven_design.hpp"
#include "learn/rules_of_thumb.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::learn {
namespace {

using Json = nlohmann::ordered_json;

constexpr double worth_explaining = 0.1;  // of the speed

/// A rule of thumb of makers beside the answer.
struct Rule {
    char const *formula, *source;
    double speed;      ///< m/s
    double low, high;  ///< m/s, what is used of it in practice
    std::string told;  ///< in the answer, without the end of the line
    std::string why_different;
};

/// Why a rule differs from the answer; empty where it does not by more than a tenth.
std::string why_different(RiskDesign const& d, double low, double high, std::string const& reason) {
    ModelForecast const& answer = d.forecasts.front();
    double const speed = answer.median_speed;
    if (low <= (1 + worth_explaining) * speed && high >= (1 - worth_explaining) * speed) return "";
    double const nearest = low > speed ? low : high;
    return fmt::format("That is {:.0f} % {} than {} says ({:.3g} m/s): {}.",
                       100 * std::abs(nearest / speed - 1), nearest > speed ? "more" : "less", answer.model,
                       speed, reason);
}

/// The rule of Daesung is a share of the trough's speed, which throw number and friction do not change.
Rule daesung(RiskDesign const& d) {
    double const rule = rule_of_daesung(d.drive), low = 0.7 * rule, high = 0.8 * rule;
    double const trough = d.drive.trough_speed();
    char const* const source = "Daesung Machinery, dsv.co.kr/vibrating_machinery_vc_06.html";
    auto const reason = fmt::format(
        "the rule is {:.2g} to {:.2g} of the trough's largest speed along itself at every throw number, "
        "friction and depth, and here the answer is {:.2g} of it, at throw number {:.3g}",
        low / trough, high / trough, d.forecasts.front().median_speed / trough, d.throw_number);
    return {
        "v = 3.81 N S, of which 70 to 80 % are used in practice",
        source,
        rule,
        low,
        high,
        fmt::format("{:.3g} m/s, of which 70 to 80 % are used in practice: {:.3g} to {:.3g} m/s (v = 3.81 "
                    "N S;\n  {})",
                    rule, low, high, source),
        why_different(d, low, high, reason)};
}

Rule without_slip(RiskDesign const& d) {
    double const rule = speed_without_slip(d.drive);
    char const* const source = "after VDI 2333, vibrationsfoerdertechnik.de";
    Rule found{"no slip, flight of n cycles: v = g n^2 cot(beta) / (2 f)", source, rule, rule, rule, "", ""};
    if (rule <= 0) {
        found.told = fmt::format("none for a trough that does not throw ({})", source);
        return found;
    }
    found.told = fmt::format("{:.3g} m/s without slip: v = g n^2 cot(beta) / (2 f) ({})", rule, source);
    found.why_different =
        why_different(d, rule, rule,
                      "the rule lets the material move with the trough whenever it touches it, whatever the "
                      "friction, and flies it as a single mass");
    return found;
}

/// Of the variance of the mass flow.
double share_of(BudgetShare const& one, ModelForecast const& f) {
    return f.flow_sd > 0 ? one.sd * one.sd / (f.flow_sd * f.flow_sd) : 0;
}

char const* source_of(AddedMassSource source) {
    static constexpr std::array names{"as makers count", "as given", "the atlas of layers"};
    return names.at(static_cast<std::size_t>(source));
}

/// The exciter of a machine under its layer.
struct ExcitedMachine {
    Exciter exciter;
    double material;     ///< kg
    double empty;        ///< m, amplitude without material
    double usual_power;  ///< W
};

ExcitedMachine excited(DesignTask const& t, RiskDesign const& d) {
    double const f = d.drive.frequency, material = material_on(t, d.depth);
    MovedMachine machine = *t.machine;
    if (!machine.exciter) machine.exciter = exciter_needed(machine, f, material, d.drive.amplitude);
    return {*machine.exciter, material, amplitude_of(machine, f, 0),
            usual_drive_power(machine.moving_mass(material), d.drive.amplitude, f)};
}

/// One line, where the atlas knows the damping of the layer.
std::string damping_text(MovedMachine const& machine) {
    if (!machine.damping) return "";
    return fmt::format(
        "damping           of the layer: {:.3g} of its mass times omega (the atlas of layers)\n",
        machine.damping->mean);
}

}  // namespace

std::string budget_text(RiskDesign const& d) {
    auto const least = std::ranges::min_element(d.forecasts, {}, &ModelForecast::probability);
    if (d.untested || least->budget.empty()) return "";
    constexpr char const* line = "{:<48} {:>9} {:>11} {:>14}\n";
    std::string text =
        fmt::format("\nWhat to measure first, by {} (mass flow +- {} t/h, one standard deviation):\n",
                    least->model, core::plain_number(tonnes_per_hour * least->flow_sd, 3));
    text += fmt::format(fmt::runtime(line), "", "alone", "share of", "sure if known");
    text += fmt::format(fmt::runtime(line), "", "+- t/h", "variance", "+ t/h");
    for (BudgetShare const& one : least->budget)
        text += fmt::format(fmt::runtime(line), one.source, core::plain_number(tonnes_per_hour * one.sd, 2),
                            fmt::format("{:.0f} %", 100 * share_of(one, *least)),
                            core::plain_number(tonnes_per_hour * one.gained, 2));
    return text;
}

Json budget_json(ModelForecast const& f) {
    Json list = Json::array();
    for (BudgetShare const& one : f.budget)
        list.push_back({{"source", one.source},
                        {"sd_t_per_h", tonnes_per_hour * one.sd},
                        {"share_of_variance", share_of(one, f)},
                        {"sure_if_known_t_per_h", tonnes_per_hour * one.gained}});
    return list;
}

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
    if (double const resonance = resonance_of(*t.machine, m.material); resonance > 0)
        text += fmt::format("resonance         {:.4g} 1/min, of the springs\n", 60 * resonance);
    text += fmt::format(
        "drive             makers of crank drives install {:.3g} W for the moved mass (F A omega / sqrt 2, "
        "ROSTA); "
        "springs\n                  and bearings lose what their makers say\n",
        m.usual_power);
    return text;
}

Json exciter_json(DesignTask const& t, RiskDesign const& d) {
    if (!t.machine) return nullptr;
    ExcitedMachine const m = excited(t, d);
    return {{"is_given", t.machine->exciter.has_value()},
            {"static_moment_kg_m", m.exciter.static_moment},
            {"centrifugal_force_n", force_of(m.exciter, d.drive.frequency)},
            {"trough_mass_kg", t.machine->mass},
            {"material_kg", m.material},
            {"added_mass_fraction", t.machine->added_mass.mean},
            {"added_mass_from", source_of(t.machine->added_mass_source)},
            {"damping", t.machine->damping ? Json(t.machine->damping->mean) : Json(nullptr)},
            {"stroke_empty_mm", 2e3 * m.empty},
            {"resonance_rpm", 60 * resonance_of(*t.machine, m.material)},
            {"usual_drive_power_w", m.usual_power}};
}

std::string rules_text(RiskDesign const& d) {
    std::string text = "\nRules of thumb, for comparison:\n";
    for (Rule const& rule : {daesung(d), without_slip(d)}) {
        text += "  " + rule.told + "\n";
        if (!rule.why_different.empty()) text += "  " + rule.why_different + "\n";
    }
    return text;
}

Json rules_json(RiskDesign const& d) {
    Json list = Json::array();
    for (Rule const& rule : {daesung(d), without_slip(d)}) {
        bool const has_range = rule.low < rule.high;
        list.push_back(
            {{"rule", rule.formula},
             {"source", rule.source},
             {"speed_m_per_s", rule.speed},
             {"low_m_per_s", has_range ? Json(rule.low) : Json(nullptr)},
             {"high_m_per_s", has_range ? Json(rule.high) : Json(nullptr)},
             {"why_different", rule.why_different.empty() ? Json(nullptr) : Json(rule.why_different)}});
    }
    return list;
}

}  // namespace vibrotrough::learn
