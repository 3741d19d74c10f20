#include "learn/design_details.hpp"

#include "core/text.hpp"
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
    std::string formula;
    char const* source;
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
    double const nearest = low > speed ? low : high, ratio = nearest / speed;
    // Beside a layer that hardly moves a percentage says nothing.
    std::string const far = ratio > 0 && ratio < 3 ? fmt::format("{:.0f} % {}", 100 * std::abs(ratio - 1),
                                                                 ratio > 1 ? "more" : "less")
                                                   : "much more";
    return fmt::format("That is {} than {} says ({:.3g} m/s): {}.", far, answer.model, speed, reason);
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
        "v = 3.81 N S (m/min, with N in 1/min and the amplitude S in m), of which 70 to 80 % are used in "
        "practice",
        source,
        rule,
        low,
        high,
        fmt::format("{:.3g} m/s, of which 70 to 80 % are used in practice: {:.3g} to {:.3g} m/s (v = 3.81 "
                    "N S in m/min,\n  with N in 1/min and the amplitude S in m; {})",
                    rule, low, high, source),
        why_different(d, low, high, reason)};
}

Rule without_slip(RiskDesign const& d) {
    double const rule = speed_without_slip(d.drive);
    char const* const source = "after VDI 2333, vibrationsfoerdertechnik.de";
    std::string const formula = d.drive.inclination == 0
                                    ? "v = g n^2 cot(beta) / (2 f)"
                                    : "v = g n^2 (cos(alpha) cot(beta) - sin(alpha)) / (2 f)";
    Rule found{"no slip, flight of n cycles: " + formula, source, rule, rule, rule, "", ""};
    if (rule <= 0) {
        found.told = fmt::format("none for a trough that does not throw ({})", source);
        return found;
    }
    found.told = fmt::format("{:.3g} m/s without slip: {} ({})", rule, formula, source);
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
