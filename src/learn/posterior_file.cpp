#include "learn/posterior_file.hpp"

#include "core/error.hpp"

#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::learn {
namespace {

using Json = nlohmann::json;

KnownFriction friction_of(Json const& calibration, Json const& parameter) {
    if (!calibration.contains("draws")) {
        // 95 % of a normal distribution lie within 1.96 standard deviations.
        double const width = parameter.at("high").get<double>() - parameter.at("low").get<double>();
        return normal_friction(parameter.at("median"), width / (2 * 1.959964));
    }
    Json const& draws = calibration.at("draws");
    Json const& discrepancy = calibration.at("model_discrepancy");
    std::vector<double> missed;
    if (!discrepancy.is_null())
        missed = draws.at(discrepancy.at("name").get<std::string>()).get<std::vector<double>>();
    return drawn_friction(draws.at(parameter.at("name").get<std::string>()).get<std::vector<double>>(),
                          missed);
}

}  // namespace

PosteriorFriction read_posterior(std::string_view text, std::string const& file) {
    std::string const what_to_give =
        "give what 'vibrotrough theory calibrate speeds.csv --free friction --posterior FILE' writes";
    try {
        Json const calibration = Json::parse(text);
        for (Json const& parameter : calibration.at("parameters")) {
            std::string const name = parameter.at("name");
            if (name == "friction" || name == "trough.friction")
                return {friction_of(calibration, parameter), calibration.value("model", "")};
        }
    } catch (Json::exception const& error) {
        throw core::InputError(
            fmt::format("{}: is not the file of a calibration ({}); {}", file, error.what(), what_to_give));
    } catch (std::invalid_argument const& error) {
        throw core::InputError(fmt::format("{}: {}; {}", file, error.what(), what_to_give));
    }
    throw core::InputError(fmt::format("{}: holds no calibrated friction; {}", file, what_to_give));
}

}  // namespace vibrotrough::learn
