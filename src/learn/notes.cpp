#include "learn/notes.hpp"

#include "core/error.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace vibrotrough::learn {
namespace {

namespace note = core::note;
using note::Json;

/// Root mean square over the measurements of what the model misses in all of them together; 0 in files of
/// version 0.2.0 and before, which do not have it.
double common_error_of(Json const& calibration) {
    if (!calibration.contains("measurements")) return 0;
    double squares = 0;
    auto const& measurements = note::list(calibration, "measurements");
    for (Json const& one : measurements) {
        if (!one.contains("common_error")) continue;
        double const common = note::number(one, "common_error", 0);
        if (common > 1) throw note::Fault("'common_error' is above 1, the largest in velocity efficiency");
        squares += common * common;
    }
    return measurements.empty() ? 0 : std::sqrt(squares / static_cast<double>(measurements.size()));
}

CalibratedFriction friction_of(Json const& calibration, Json const& parameter) {
    std::string const model = note::text_if_any(calibration, "model");
    if (!calibration.contains("draws")) {
        CalibratedFriction const known{model,
                                       note::number(parameter, "median", 0),
                                       note::number(parameter, "low", 0),
                                       note::number(parameter, "high", 0),
                                       {}};
        if (!(known.low <= known.median && known.median <= known.high))
            throw note::Fault("'median' lies outside of its own interval");
        return known;
    }
    Json const& draws = note::object(calibration, "draws");
    CalibratedFriction known{model, 0, 0, 0, note::numbers(draws, note::text(parameter, "name"))};
    if (!calibration.contains("model_discrepancy")) throw note::Fault("'model_discrepancy' is missing");
    if (!calibration.at("model_discrepancy").is_null()) {
        Json const& discrepancy = note::object(calibration, "model_discrepancy");
        known.discrepancies = note::numbers(draws, note::text(discrepancy, "name"));
        double const common = common_error_of(calibration);
        for (double& one : known.discrepancies) one = std::hypot(one, common);
    }
    return known;
}

}  // namespace

std::map<std::string, double> parse_half_widths(std::string_view text) {
    std::map<std::string, double> wanted;
    Json const json = note::parse(text);
    Json const& half_widths = note::object(json, "half_widths");
    for (auto const& [id, half_width] : half_widths.items()) {
        if (!half_width.is_number() || half_width.get<double>() <= 0)
            throw note::Fault("'half_widths' holds what is not a number above 0");
        wanted[id] = half_width.get<double>();
    }
    return wanted;
}

CalibratedFriction parse_calibration(std::string_view text) {
    Json const calibration = note::parse(text);
    for (Json const& parameter : note::list(calibration, "parameters")) {
        std::string const name = note::text(parameter, "name");
        if (name != "friction" && name != "trough.friction") continue;
        CalibratedFriction known = friction_of(calibration, parameter);
        if (auto const converged = calibration.find("converged"); converged != calibration.end())
            known.converged = *converged == true;
        return known;
    }
    throw note::Fault("it holds no calibrated friction");
}

std::pair<KnownFriction, std::string> read_posterior(std::string_view text, std::string const& file) {
    std::string const what_to_give =
        "give what 'vibrotrough theory calibrate speeds.csv --free friction --posterior FILE' writes";
    try {
        CalibratedFriction const known = parse_calibration(text);
        if (!known.converged)
            throw core::InputError(fmt::format(
                "{}: the chains of this calibration have not converged, so that its numbers must not be "
                "used; calibrate again with fewer free quantities, or with narrower priors",
                file));
        if (!known.draws.empty()) return {drawn_friction(known.draws, known.discrepancies), known.model};
        // 95 % of a normal distribution lie within 1.96 standard deviations.
        return {normal_friction(known.median, (known.high - known.low) / (2 * 1.959964)), known.model};
    } catch (core::note::Fault const& fault) {
        throw core::InputError(
            fmt::format("{}: is not the file of a calibration: {}; {}", file, fault.what(), what_to_give));
    } catch (std::invalid_argument const& error) {
        throw core::InputError(fmt::format("{}: {}; {}", file, error.what(), what_to_give));
    }
}

}  // namespace vibrotrough::learn
