#include "learn/design_details.hpp"

#include "core/text.hpp"
#include "learn/driven_design.hpp"
#include "learn/rules_of_thumb.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::learn {
namespace {

using Json = nlohmann::ordered_json;

constexpr char const* source_of_daesung = "Daesung Machinery, dsv.co.kr/vibrating_machinery_vc_06.html";
constexpr char const* source_of_vdi = "after VDI 2333, vibrationsfoerdertechnik.de";
constexpr double worth_explaining = 0.1;  // of the speed

/// Why a rule that says speeds from `low` to `high` m/s differs from the answer; nothing where it does not by
/// more than a tenth.
std::optional<std::string> why_different(RiskDesign const& d, double low, double high,
                                         std::string const& reason) {
    ModelForecast const& answer = d.forecasts.front();
    double const speed = answer.median_speed;
    if (low <= (1 + worth_explaining) * speed && high >= (1 - worth_explaining) * speed) return {};
    double const nearest = low > speed ? low : high;
    return fmt::format("That is {:.0f} % {} than {} says ({:.3g} m/s): {}.",
                       100 * std::abs(nearest / speed - 1), nearest > speed ? "more" : "less", answer.model,
                       speed, reason);
}

/// The rule of Daesung is a share of the trough's speed, which throw number and friction do not change.
std::optional<std::string> why_daesung_differs(RiskDesign const& d) {
    double const rule = rule_of_daesung(d.drive), trough = d.drive.trough_speed();
    return why_different(
        d, 0.7 * rule, 0.8 * rule,
        fmt::format("the rule is {:.2g} to {:.2g} of the trough's largest speed along itself at every throw "
                    "number, friction and depth, and here the answer is {:.2g} of it, at throw number {:.3g}",
                    0.7 * rule / trough, 0.8 * rule / trough, d.forecasts.front().median_speed / trough,
                    d.throw_number));
}

std::optional<std::string> why_no_slip_differs(RiskDesign const& d) {
    double const rule = speed_without_slip(d.drive);
    if (rule <= 0) return {};
    return why_different(
        d, rule, rule,
        "the rule lets the material move with the trough whenever it touches it, whatever the "
        "friction, and flies it as a single mass");
}

/// Of the variance of the mass flow.
double share_of(BudgetShare const& one, ModelForecast const& f) {
    return f.flow_sd > 0 ? one.sd * one.sd / (f.flow_sd * f.flow_sd) : 0;
}

char const* source_of(AddedMassSource source) {
    switch (source) {
        case AddedMassSource::given:
            return "as given";
        case AddedMassSource::atlas:
            return "the atlas of layers";
        case AddedMassSource::maker:
            break;
    }
    return "as makers count";
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
    double const daesung = rule_of_daesung(d.drive), no_slip = speed_without_slip(d.drive);
    auto const explained = [](std::optional<std::string> const& why) {
        return why ? "  " + *why + "\n" : std::string();
    };
    std::string text = fmt::format(
        "\nRules of thumb, for comparison:\n  {:.3g} m/s, of which 70 to 80 % are used in "
        "practice: {:.3g} to {:.3g} m/s (v = 3.81 N S;\n  {})\n",
        daesung, 0.7 * daesung, 0.8 * daesung, source_of_daesung);
    text += explained(why_daesung_differs(d));
    text += no_slip > 0 ? fmt::format("  {:.3g} m/s without slip: v = g n^2 cot(beta) / (2 f) ({})\n",
                                      no_slip, source_of_vdi)
                        : fmt::format("  none for a trough that does not throw ({})\n", source_of_vdi);
    return text + explained(why_no_slip_differs(d));
}

Json rules_json(RiskDesign const& d) {
    double const daesung = rule_of_daesung(d.drive);
    auto const known = [](std::optional<std::string> const& why) { return why ? Json(*why) : Json(nullptr); };
    return {{{"rule", "v = 3.81 N S, of which 70 to 80 % are used in practice"},
             {"source", source_of_daesung},
             {"speed_m_per_s", daesung},
             {"low_m_per_s", 0.7 * daesung},
             {"high_m_per_s", 0.8 * daesung},
             {"why_different", known(why_daesung_differs(d))}},
            {{"rule", "no slip, flight of n cycles: v = g n^2 cot(beta) / (2 f)"},
             {"source", source_of_vdi},
             {"speed_m_per_s", speed_without_slip(d.drive)},
             {"low_m_per_s", nullptr},
             {"high_m_per_s", nullptr},
             {"why_different", known(why_no_slip_differs(d))}}};
}

}  // namespace vibrotrough::learn
