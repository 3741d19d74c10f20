#include "learn/design_report.hpp"

#include "core/text.hpp"
#include "learn/design_details.hpp"
#include "learn/driven_design.hpp"
#include "learn/machine_keys.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::learn {
namespace {

using Json = nlohmann::ordered_json;

/// kg, of the material on the whole trough, or kg per metre of it.
double material(DesignTask const& t, RiskDesign const& d) {
    return t.bulk_density * t.width * d.depth * (t.length > 0 ? t.length : 1);
}

/// W, given to the material on the whole trough by the point mass, or W per metre of it.
double power(DesignTask const& t, RiskDesign const& d) {
    return d.power_per_mass * material(t, d);
}

/// The same by the atlas of layers, where it knows the layer.
std::optional<atlas::Bounded> atlas_power(DesignTask const& t, RiskDesign const& d) {
    auto const load = load_of(t, d);
    if (!load) return {};
    auto const power = power_per_mass(*load, d.drive.amplitude, d.drive.frequency);
    if (!power) return {};
    return atlas::Bounded{power->value * material(t, d), power->half_width * material(t, d)};
}

/// A number that says how probable something is; none where that is not known.
Json if_known(RiskDesign const& d, double value) {
    return d.untested ? Json(nullptr) : Json(value);
}

Json as_json(ModelForecast const& f, bool is_known) {
    auto const half_width = [&](double ModelEfficiency::*sd) {
        return f.efficiency ? Json(atlas::deviations_in_half_width * ((*f.efficiency).*sd)) : Json(nullptr);
    };
    auto const known = [&](double value) { return is_known ? Json(value) : Json(nullptr); };
    return {{"model", f.model},
            {"median_speed_m_per_s", f.median_speed},
            {"sure_speed_m_per_s", known(f.sure_speed)},
            {"mass_flow_t_per_h", tonnes_per_hour * f.median_flow},
            {"mass_flow_low_t_per_h", known(tonnes_per_hour * f.low_flow)},
            {"mass_flow_high_t_per_h", known(tonnes_per_hour * f.high_flow)},
            {"probability", known(f.probability)},
            {"mass_flow_sd_t_per_h", known(tonnes_per_hour * f.flow_sd)},
            {"budget", is_known ? budget_json(f) : Json::array()},
            {"efficiency", f.efficiency ? Json(f.efficiency->efficiency) : Json(nullptr)},
            {"efficiency_half_width_statistics", half_width(&ModelEfficiency::statistics_sd)},
            {"numerical_error", half_width(&ModelEfficiency::numerics_sd)},
            {"efficiency_half_width",
             f.efficiency ? Json(atlas::deviations_in_half_width * f.efficiency->sd()) : Json(nullptr)}};
}

/// "frictions of 0.25 to 0.35", or "a friction of 0.3" where it is known exactly.
std::string range_of_friction(KnownFriction const& known) {
    std::string const low = fmt::format("{:.3g}", known.low), high = fmt::format("{:.3g}", known.high);
    if (low == high) return "a friction of " + low;
    std::string const cut =
        known.draws.empty()
            ? fmt::format(", which is {:.3g} +- three standard deviations of {:.3g}", known.median, known.sd)
            : "";
    return fmt::format("frictions of {} to {}{}", low, high, cut);
}

/// Where the workshop's steps of 0.1 mm and half a degree would cost more than half a percent, and finer ones
/// are printed.
std::string finer_steps(DesignTask const& t, theory::Drive const& m) {
    auto const is_off = [](double value, theory::Range const& range, double step) {
        constexpr double tiny = 1e-6;
        return range.low < range.high && std::abs(value / step - std::round(value / step)) > tiny;
    };
    bool const stroke = is_off(m.amplitude, t.space.amplitude, 5e-5);
    bool const angle = is_off(m.vibration_angle, t.space.vibration_angle, degree / 2) ||
                       is_off(m.inclination, t.space.inclination, degree / 2);
    if (!stroke && !angle) return "";
    return fmt::format("set it exactly    steps of {} would cost more than half a percent\n",
                       stroke && angle ? "0.1 mm and half a degree"
                       : stroke        ? "0.1 mm"
                                       : "half a degree");
}

std::string machine_text(DesignTask const& t, RiskDesign const& d) {
    theory::Drive const& m = d.drive;
    std::string text = t.material.empty() ? "" : fmt::format("material          {}\n", t.material);
    text += fmt::format("stroke            {:.4g} mm (amplitude {:.4g} mm)\n", 2e3 * m.amplitude,
                        1e3 * m.amplitude);
    text += fmt::format("speed of drive    {:.4g} 1/min ({:.4g} Hz)\n", 60 * m.frequency, m.frequency);
    text += fmt::format("vibration angle   {:.4g} degrees\ninclination       {:.4g} degrees\n",
                        m.vibration_angle / degree, m.inclination / degree);
    text += finer_steps(t, m);
    text += fmt::format("layer depth       {:.4g} mm\n", std::round(1e4 * d.depth) / 10);
    double const nominal = t.mass_flow / t.surge;
    if (auto const depth = depth_at(t, d, nominal))
        text +=
            fmt::format("in operation      {:.0f} mm deep at {} t/h and the most likely speed{}\n",
                        1e3 * *depth, core::plain_number(tonnes_per_hour * nominal, 4),
                        t.surge > 1 ? fmt::format("; made for a surge of {:g} times as much", t.surge) : "");
    text += fmt::format("side walls        {:.0f} mm or higher (half of the layer, or 50 mm, above it)\n",
                        1e3 * side_wall(d.depth));
    text +=
        fmt::format("throw number      {:.3g}\nmachine number    {:.3g}\n", d.throw_number, d.machine_number);
    text += fmt::format("landing speed     {:.3g} m/s at most, for {} (point mass, mode {})\n",
                        d.landing_speed, range_of_friction(t.friction), d.mode);
    auto const by_atlas = atlas_power(t, d);
    text += fmt::format("power             {} W{} given to the material (point mass){}\n",
                        core::plain_number(power(t, d), 3), t.length > 0 ? "" : " per metre of trough",
                        by_atlas ? fmt::format("; {:.3g} +- {:.2g} W by the atlas of layers", by_atlas->value,
                                               by_atlas->half_width)
                                 : "");
    text += drive_text(t, d) + exciter_text(t, d);
    if (t.length > 0 && d.sure_speed > 0 && !d.untested)
        text += fmt::format("time on trough    {:.3g} s at most, with {:.4g} %\n", t.length / d.sure_speed,
                            100 * t.confidence);
    return text;
}

/// Of a model that rests on simulations: its velocity efficiency, and how much of its uncertainty is
/// statistics and how much numerics. Empty for an exact theory.
std::string own_uncertainty(ModelForecast const& f) {
    if (!f.efficiency || f.efficiency->sd() == 0) return "";
    auto const half_width = [](double sd) { return atlas::deviations_in_half_width * sd; };
    return fmt::format(
        "\n{}: velocity efficiency {:.3f} +- {:.3f}, of which statistics {:.3f} and numerical errors of the "
        "simulations {:.3f} (at the median of the friction)\n",
        f.model, f.efficiency->efficiency, half_width(f.efficiency->sd()),
        half_width(f.efficiency->statistics_sd), half_width(f.efficiency->numerics_sd));
}

/// How many troughs of the task's width carry the mass flow side by side.
int troughs_needed(DesignTask const& t, RiskDesign const& d) {
    return static_cast<int>(std::ceil(*d.width_needed / t.width - 1e-9));
}

/// What the machine carries at the confidence, as a sentence.
std::string most_that_is_carried(RiskDesign const& d) {
    return fmt::format("The one that comes nearest carries {} t/h so surely, in a layer of {:.4g} mm.",
                       core::plain_number(tonnes_per_hour * d.sure_flow, 3), 1e3 * d.depth);
}

/// A row of the table of models.
std::string row_of(ModelForecast const& f, bool is_known) {
    auto const known = [&](std::string const& words) { return is_known ? words : "not known"; };
    auto const flow = [](double value) { return core::plain_number(tonnes_per_hour * value, 3); };
    return fmt::format("{:<24} {:>9.3g} {:>9} {:>10} {:>17} {:>12}\n", f.model, f.median_speed,
                       known(fmt::format("{:.3g}", f.sure_speed)), flow(f.median_flow),
                       known(fmt::format("{} to {}", std::isfinite(f.low_flow) ? flow(f.low_flow) : "none",
                                         flow(f.high_flow))),
                       known(fmt::format("{:.1f} %", 100 * f.probability)));
}

/// The machines for the speeds of the drive that can be had; empty when any can.
std::string speeds_text(RiskDesign const& d) {
    if (d.choices.empty()) return "";
    std::string text = fmt::format("\n{:<24} {:>9} {:>9} {:>10} {:>17} {:>12}\n", "speed of the drive",
                                   "stroke", "sure", "layer", "machine number", "probability");
    text += fmt::format("{:<24} {:>9} {:>9} {:>10}\n", "1/min", "mm", "m/s", "mm");
    for (Choice const& one : d.choices) {
        auto const choice = [](double value) { return value > 0 ? fmt::format("{:.4g}", value) : "any"; };
        std::string const speed = choice(60 * one.frequency), stroke = choice(2e3 * one.amplitude);
        if (!one.design) {
            text += fmt::format("{:<24} {:>9} {}\n", speed, stroke, one.why_none);
            continue;
        }
        RiskDesign const& its = *one.design;
        auto const known = [&](std::string const& words) { return its.untested ? "not known" : words; };
        text += fmt::format("{:<24} {:>9} {:>9} {:>10.4g} {:>17.3g} {:>12}\n", speed, stroke,
                            known(fmt::format("{:.3g}", its.sure_speed)), 1e3 * its.depth, its.machine_number,
                            known(fmt::format("{:.1f} %", 100 * its.probability)));
    }
    return text;
}

Json as_json(Choice const& one) {
    Json json{{"rpm", 60 * one.frequency}, {"feasible", one.design && one.design->feasible}};
    if (!one.design) {
        json["why_none"] = one.why_none;
        if (one.amplitude > 0) json["stroke_mm"] = 2e3 * one.amplitude;
        return json;
    }
    RiskDesign const& its = *one.design;
    json["stroke_mm"] = 2e3 * one.amplitude;
    json["sure_speed_m_per_s"] = if_known(its, its.sure_speed);
    json["layer_depth_mm"] = 1e3 * its.depth;
    json["probability"] = if_known(its, its.probability);
    json["machine_number"] = its.machine_number;
    json["landing_speed_m_per_s"] = its.landing_speed;
    json["vibration_angle_deg"] = its.drive.vibration_angle / degree;
    json["inclination_deg"] = its.drive.inclination / degree;
    json["rank"] = one.rank;
    return json;
}

/// What was asked for.
Json as_json(DesignTask const& t) {
    return {{"width_m", t.width},
            {"length_m", t.length},
            {"bulk_density_kg_per_m3", t.bulk_density},
            {"depth_m", {t.depth.low, t.depth.high}},
            {"rpm", {60 * t.space.frequency.low, 60 * t.space.frequency.high}},
            {"stroke_mm", {2e3 * t.space.amplitude.low, 2e3 * t.space.amplitude.high}},
            {"vibration_angle_deg",
             {t.space.vibration_angle.low / degree, t.space.vibration_angle.high / degree}},
            {"inclination_deg", {t.space.inclination.low / degree, t.space.inclination.high / degree}},
            {"max_machine_number", t.space.max_machine_number},
            {"max_throw_number", t.space.max_throw_number},
            {"max_landing_speed_m_per_s", t.landing_speed ? Json(*t.landing_speed) : Json()},
            {"grain_diameter_mm", t.grain_diameter ? Json(1e3 * *t.grain_diameter) : Json()},
            {"rolling_friction", t.rolling_friction ? Json(*t.rolling_friction) : Json()},
            {"material", t.material},
            {"surge", t.surge},
            {"drive", t.drive_kind ? Json(t.drive_kind->name) : Json()}};
}

}  // namespace

std::string name_of(Objective objective) {
    static constexpr std::array names{"fastest", "gentlest-landing", "least-machine-number", "least-power"};
    return names.at(static_cast<std::size_t>(objective));
}

std::string first_sentence(DesignTask const& t, RiskDesign const& d) {
    std::string const wanted = core::plain_number(tonnes_per_hour * t.mass_flow, 4);
    if (d.untested) {
        return fmt::format(
            "Not tested: no probability is known that this trough carries {} t/h with a layer of {:.3g} "
            "mm, "
            "because {}.",
            wanted, 1e3 * d.depth, *d.untested);
    }
    if (d.feasible)
        return fmt::format("This trough carries {} t/h with a probability of {:.4g} % or more.", wanted,
                           100 * t.confidence);
    std::string text =
        fmt::format("No machine within the limits carries {} t/h with a probability of {:.4g} %", wanted,
                    100 * t.confidence);
    // Beyond this, a probability says no more than "never".
    if (d.probability >= 0.001)
        text += fmt::format("; the one that comes nearest does with {:.1f} %", 100 * d.probability);
    if (!d.width_needed)
        return text +
               ". So surely, none conveys anything: ask for a lower confidence, or know the "
               "friction better.";
    return text + fmt::format(". {} It would take a trough {:.0f} mm wide, or {} troughs side by side.",
                              most_that_is_carried(d), std::ceil(1e3 * *d.width_needed),
                              troughs_needed(t, d));
}

std::string design_text(DesignTask const& t, RiskDesign const& d) {
    std::string text = first_sentence(t, d) + "\n\n" + machine_text(t, d);
    text += fmt::format("held back by      {}\n", d.active_limits.empty()
                                                      ? "nothing"
                                                      : fmt::format("{}", fmt::join(d.active_limits, ", ")));
    std::string const sure = fmt::format("{:.4g} %", 100 * t.confidence);
    text += fmt::format("\n{:<24} {:>9} {:>9} {:>10} {:>17} {:>12}\n", "model", "speed", sure, "mass flow",
                        "95 % interval", "probability");
    text += fmt::format("{:<24} {:>9} {:>9} {:>10} {:>17} {:>12}\n", "", "m/s", "m/s", "t/h", "t/h",
                        fmt::format("of {} t/h", core::plain_number(tonnes_per_hour * t.mass_flow, 4)));
    for (ModelForecast const& f : d.forecasts) text += row_of(f, !d.untested);
    if (!d.beside.empty()) text += "beside it, for comparison:\n";
    for (ModelForecast const& f : d.beside) text += row_of(f, !f.untested);
    for (ModelForecast const& f : d.forecasts) text += own_uncertainty(f);
    text += budget_text(d) + speeds_text(d);
    text += rules_text(d);
    for (std::string const& warning : d.warnings) text += "\n" + warning + "\n";
    return text;
}

Json design_json(DesignTask const& t, RiskDesign const& d) {
    theory::Drive const& m = d.drive;
    auto const by_atlas = atlas_power(t, d);
    auto const in_operation = depth_at(t, d, t.mass_flow / t.surge);
    Json json{{"task", as_json(t)},
              {"feasible", d.feasible},
              {"sentence", first_sentence(t, d)},
              {"stroke_mm", 2e3 * m.amplitude},
              {"amplitude_m", m.amplitude},
              {"rpm", 60 * m.frequency},
              {"frequency_hz", m.frequency},
              {"vibration_angle_deg", m.vibration_angle / degree},
              {"inclination_deg", m.inclination / degree},
              {"layer_depth_mm", 1e3 * d.depth},
              {"depth_in_operation_mm", in_operation ? Json(1e3 * *in_operation) : Json(nullptr)},
              {"side_wall_mm", 1e3 * side_wall(d.depth)},
              {"throw_number", d.throw_number},
              {"machine_number", d.machine_number},
              {"mode", d.mode},
              {"velocity_efficiency_point_mass", d.efficiency},
              {"landing_speed_m_per_s", d.landing_speed},
              {"friction_low", t.friction.low},
              {"friction_median", t.friction.median},
              {"friction_high", t.friction.high},
              {t.length > 0 ? "power_w" : "power_w_per_m", power(t, d)},
              {"power_by_atlas", by_atlas ? Json(by_atlas->value) : Json(nullptr)},
              {"power_by_atlas_half_width", by_atlas ? Json(by_atlas->half_width) : Json(nullptr)},
              {"mass_flow_wanted_t_per_h", tonnes_per_hour * t.mass_flow},
              {"confidence", t.confidence},
              {"probability", if_known(d, d.probability)},
              {"sure_speed_m_per_s", if_known(d, d.sure_speed)},
              {"sure_mass_flow_t_per_h", if_known(d, tonnes_per_hour * d.sure_flow)},
              {"untested", d.untested ? Json(*d.untested) : Json(nullptr)},
              {"time_on_trough_s",
               t.length > 0 && d.sure_speed > 0 ? if_known(d, t.length / d.sure_speed) : Json(nullptr)},
              {"exciter", exciter_json(t, d)},
              {"objective", name_of(t.objective)},
              {"width_needed_m", d.width_needed ? Json(*d.width_needed) : Json(nullptr)},
              {"troughs_needed", d.width_needed ? Json(troughs_needed(t, d)) : Json(nullptr)},
              {"models", Json::array()},
              {"models_beside", Json::array()},
              {"speeds_compared", Json::array()},
              {"active_limits", d.active_limits},
              {"rules_of_thumb", rules_json(d)},
              {"warnings", d.warnings}};
    for (ModelForecast const& f : d.forecasts) json["models"].push_back(as_json(f, !d.untested));
    for (ModelForecast const& f : d.beside) json["models_beside"].push_back(as_json(f, !f.untested));
    for (Choice const& one : d.choices) json["speeds_compared"].push_back(as_json(one));
    return json;
}

Json design_page_data(DesignTask const& t, RiskDesign const& d) {
    Json json = design_json(t, d);
    json["quantile_shares"] = quantile_shares();
    auto const add_quantiles = [](Json& model, ModelForecast const& f, bool is_known) {
        Json& list = model["mass_flow_quantiles_t_per_h"] = Json::array();
        if (!is_known) return;
        for (double const flow : f.flow_quantiles) list.push_back(tonnes_per_hour * flow);
    };
    for (std::size_t i = 0; i < d.forecasts.size(); ++i)
        add_quantiles(json["models"][i], d.forecasts[i], !d.untested);
    for (std::size_t i = 0; i < d.beside.size(); ++i)
        add_quantiles(json["models_beside"][i], d.beside[i], !d.beside[i].untested);
    return json;
}

}  // namespace vibrotrough::learn
