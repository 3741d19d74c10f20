#include "learn/calibration_report.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::learn {
namespace {

using Json = nlohmann::ordered_json;

constexpr double contradicted_below = 0.01;
constexpr std::size_t most_draws_in_plot = 4000;

std::string words_of(std::string name) {
    std::ranges::replace(name, '_', ' ');
    return name;
}

std::string with_unit(double value, std::string const& unit) {
    return unit == "1" ? fmt::format("{:.3g}", value) : fmt::format("{:.3g} {}", value, unit);
}

std::string interval(Estimate const& e) {
    return fmt::format("{} {} ({:.3g} to {:.3g})", words_of(e.parameter.name),
                       with_unit(e.median, e.parameter.unit), e.low, e.high);
}

std::string list(std::vector<std::string> const& words) {
    if (words.size() < 2) return fmt::format("{}", fmt::join(words, ""));
    return fmt::format("{} and {}", fmt::join(words.begin(), words.end() - 1, ", "), words.back());
}

std::string first_sentence(Calibration const& c, std::string const& model) {
    std::vector<std::string> found, best, names;
    for (std::size_t p = 0; p < c.parameters.size(); ++p) {
        Estimate const& e = c.parameters[p];
        found.push_back(interval(e));
        names.push_back(words_of(e.parameter.name));
        best.push_back(fmt::format("{} {}", names.back(), with_unit(c.best.values[p], e.parameter.unit)));
    }
    auto const n = c.misfits.size();
    std::string const these = n == 1 ? "this speed" : fmt::format("these {} speeds", n);
    if (c.best.degrees_of_freedom <= 0) {
        return fmt::format(
            "There are as many free parameters as speeds or more, so {} cannot be tested: {} would explain "
            "{}.",
            model, list(found), these);
    }
    if (c.best.p_value < contradicted_below) {
        return fmt::format(
            "No {}{} explains {} by {} within their uncertainties: the best fit, with {}, has chi-square "
            "{:.3g} with {} degrees of "
            "freedom (p = {:.1g}).",
            names.size() > 1 ? "combination of " : "", list(names), these, model, list(best),
            c.best.chi_square, c.best.degrees_of_freedom, c.best.p_value);
    }
    std::string whole = model;
    whole[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(whole[0])));
    return fmt::format("{} with {} explains {} (chi-square {:.3g} with {} degrees of freedom, p = {:.2g}).",
                       whole, list(found), these, c.best.chi_square, c.best.degrees_of_freedom,
                       c.best.p_value);
}

Json as_json(inference::Bounds const& b) {
    return {b.low, b.high};
}

Json as_json(Estimate const& e) {
    Json ranges = Json::array();
    for (auto const& range : e.ranges) ranges.push_back(as_json(range));
    return {{"name", e.parameter.name},
            {"unit", e.parameter.unit},
            {"median", e.median},
            {"low", e.low},
            {"high", e.high},
            {"rhat", e.rhat},
            {"ess", e.ess},
            {"remaining", e.remaining},
            {"identifiable", e.identifiable},
            {"ranges", ranges},
            {"prior", as_json(e.parameter.prior)}};
}

std::string parameter_row(Estimate const& e, std::string const& note) {
    return fmt::format("{:<18} {:>9.4g} {:>9.4g} {:>9.4g}  {:<7} {:>6.3f} {:>6.0f}  {:>6.0f} %  {}\n",
                       e.parameter.name, e.median, e.low, e.high, e.parameter.unit, e.rhat, e.ess,
                       100 * (1 - e.remaining), note);
}

std::string note_of(Estimate const& e) {
    if (!e.identifiable) return "not identifiable";
    if (e.ranges.size() < 2) return "";
    std::vector<std::string> ranges;
    for (auto const& r : e.ranges) ranges.push_back(fmt::format("{:.3g} to {:.3g}", r.low, r.high));
    return list(ranges);
}

/// By how much the layers of the atlas miss the point mass where the speeds were measured.
std::string known_misses(Calibration const& c) {
    double least = 1, most = 0;
    // Smaller ones are those of settings that the atlas does not know, up to rounding.
    auto const is_known = [](Misfit const& m) { return m.common_error >= discrepancy_prior.low; };
    auto const unknown = std::ranges::count_if(c.misfits, std::not_fn(is_known));
    for (Misfit const& m : c.misfits) {
        if (is_known(m)) least = std::min(least, m.common_error);
        most = std::max(most, m.common_error);
    }
    return fmt::format(
        "The intervals hold that the point mass misses layers of spheres at these settings by {:.2g} to "
        "{:.2g} (root mean square in velocity efficiency, by the atlas{}); where it is exact, as for a "
        "block, write --common-error 0.",
        least, most, unknown > 0 ? fmt::format(", which does not know {} of them", unknown) : "");
}

}  // namespace

std::vector<std::string> verdict(Calibration const& c, std::string const& model) {
    std::vector<std::string> sentences{first_sentence(c, model)};
    if (c.discrepancy && c.best.degrees_of_freedom > 0 && c.best.p_value < contradicted_below) {
        std::vector<std::string> found;
        for (Estimate const& e : c.parameters) found.push_back(interval(e));
        sentences.push_back(fmt::format(
            "If it may be wrong {}by {:.2g} ({:.2g} to {:.2g}) in velocity efficiency from setting "
            "to setting, the speeds give {}.",
            c.holds_layer_errors ? "as at layers of spheres, and further " : "", c.discrepancy->median,
            c.discrepancy->low, c.discrepancy->high, list(found)));
    }
    for (Estimate const& e : c.parameters) {
        if (!e.identifiable) {
            sentences.push_back(
                fmt::format("The {} is not identifiable from these speeds: they rule out only {:.0f} % of "
                            "the range {:.3g} to {:.3g}.",
                            words_of(e.parameter.name), 100 * (1 - e.remaining), e.parameter.prior.low,
                            e.parameter.prior.high));
        } else if (e.ranges.size() > 1) {
            sentences.push_back(
                fmt::format("Separate values of the {} fit: {}.", words_of(e.parameter.name), note_of(e)));
        }
    }
    if (!c.converged) {
        sentences.emplace_back(
            "The chains have not converged (an R-hat is above 1.01 or an effective sample size below 400); "
            "do not use these "
            "numbers, and narrow the ranges with --prior or free fewer quantities.");
    }
    if (c.holds_layer_errors) sentences.push_back(known_misses(c));
    return sentences;
}

std::string calibration_text(Calibration const& c, std::string const& model) {
    std::string text = fmt::format("{:<18} {:>9} {:>9} {:>9}  {:<7} {:>6} {:>6}  {:>8}\n", "parameter",
                                   "median", "2.5 %", "97.5 %", "unit", "R-hat", "ESS", "narrowed");
    for (Estimate const& e : c.parameters) text += parameter_row(e, note_of(e));
    if (c.discrepancy) text += parameter_row(*c.discrepancy, "in velocity efficiency");
    text += fmt::format("\n{:>4} {:>8} {:>8} {:>10} {:>10} {:>10} {:>21} {:>8}\n", "line", "stroke", "rpm",
                        "measured", "+-", "model", "95 % interval", "misfit");
    text += fmt::format("{:>4} {:>8} {:>8} {:>10} {:>10} {:>10} {:>21} {:>8}\n", "", "mm", "1/min", "m/s",
                        "m/s", "m/s", "m/s", "in +-");
    for (Misfit const& m : c.misfits) {
        text += fmt::format("{:>4} {:>8.4g} {:>8.5g} {:>10.4g} {:>10.2g} {:>10.4g} {:>21} {:>+8.1f}\n",
                            m.measured.line, 2000 * m.measured.amplitude, 60 * m.measured.frequency,
                            m.measured.speed, m.measured.uncertainty, m.median,
                            fmt::format("{:.4g} to {:.4g}", m.low, m.high), m.in_uncertainties);
    }
    text += "\n";
    for (std::string const& sentence : verdict(c, model)) text += sentence + "\n";
    return text;
}

nlohmann::ordered_json calibration_json(Calibration const& c, std::string const& model) {
    Json json{{"model", model}, {"parameters", Json::array()}};
    for (Estimate const& e : c.parameters) json["parameters"].push_back(as_json(e));
    json["model_discrepancy"] = c.discrepancy ? as_json(*c.discrepancy) : Json();
    json["measurements"] = Json::array();
    for (Misfit const& m : c.misfits) {
        json["measurements"].push_back({{"line", m.measured.line},
                                        {"amplitude_m", m.measured.amplitude},
                                        {"frequency_hz", m.measured.frequency},
                                        {"speed_m_per_s", m.measured.speed},
                                        {"uncertainty_m_per_s", m.measured.uncertainty},
                                        {"model_m_per_s", m.median},
                                        {"model_low_m_per_s", m.low},
                                        {"model_high_m_per_s", m.high},
                                        {"common_error", m.common_error},
                                        {"misfit", m.in_uncertainties}});
    }
    json["best_fit"] = {{"values", c.best.values},
                        {"chi_square", c.best.chi_square},
                        {"degrees_of_freedom", c.best.degrees_of_freedom},
                        {"p_value", c.best.p_value}};
    json["converged"] = c.converged;
    json["verdict"] = verdict(c, model);
    return json;
}

nlohmann::ordered_json corner_plot_data(Calibration const& c, std::string const& model) {
    Json json = calibration_json(c, model);
    json["draws"] = Json::object();
    auto const add = [&](Estimate const& e) {
        std::size_t const step = std::max<std::size_t>(1, e.draws.size() / most_draws_in_plot);
        Json& draws = json["draws"][e.parameter.name] = Json::array();
        for (std::size_t i = 0; i < e.draws.size(); i += step) draws.push_back(e.draws[i]);
    };
    for (Estimate const& e : c.parameters) add(e);
    if (c.discrepancy) add(*c.discrepancy);
    return json;
}

}  // namespace vibrotrough::learn
