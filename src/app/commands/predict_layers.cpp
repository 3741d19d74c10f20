#include "app/commands/predict_layers.hpp"

#include "app/json_list.hpp"
#include "atlas/atlas.hpp"
#include "core/csv.hpp"
#include "core/text.hpp"
#include "prepare/prepared_case.hpp"
#include "scenario/reader/campaign_file.hpp"
#include "scenario/reader/swept_keys.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::app {
namespace {

using Json = nlohmann::ordered_json;

/// What the atlas says of one case.
struct PredictedLayer {
    std::string label;             ///< what distinguishes it from the others of its campaign
    atlas::Answer answer;          ///< of the atlas
    std::optional<double> theory;  ///< velocity efficiency of the point mass
    double velocity_scale;         ///< m/s
    std::optional<double> speed() const {
        return answer.efficiency ? std::optional(*answer.efficiency * velocity_scale) : std::nullopt;
    }
    std::string outside(std::string atlas::Outside::*part, std::string_view separator) const {
        std::vector<std::string> texts;
        for (atlas::Outside const& one : answer.outside) texts.push_back(one.*part);
        return fmt::format("{}", fmt::join(texts, separator));
    }
};

std::vector<PredictedLayer> predict_all(scenario::Campaign const& campaign) {
    std::vector<PredictedLayer> layers;
    prepare::CasePreparer preparer;
    for (scenario::Scenario const& scenario : campaign.cases) {
        prepare::PreparedCase const prepared = preparer.prepare(scenario);
        std::string const label = swept_label(scenario, campaign.swept);
        auto const motion = prepare::solve(prepared.point_mass);
        layers.push_back({label.empty() ? campaign.name : label, atlas::predict(prepared),
                          motion.converged ? std::optional(motion.velocity_efficiency) : std::nullopt,
                          prepared.velocity_scale});
    }
    return layers;
}

Json as_json(PredictedLayer const& layer) {
    Json names = Json::array();
    for (atlas::Outside const& one : layer.answer.outside) names.push_back(one.name);
    return {{"case", layer.label},
            {"efficiency", number_or_null(layer.answer.efficiency)},
            {"half_width", number_or_null(layer.answer.half_width)},
            {"speed_m_per_s", number_or_null(layer.speed())},
            {"efficiency_theory", number_or_null(layer.theory)},
            {"inside", layer.answer.is_inside()},
            {"outside", names}};
}

std::string cell(std::optional<double> const& value) {
    return value ? fmt::format("{}", *value) : "";
}

void print_csv(std::vector<PredictedLayer> const& layers) {
    fmt::print("case,efficiency,half_width,speed_m_per_s,efficiency_theory,inside,outside\n");
    for (PredictedLayer const& layer : layers) {
        fmt::print("{},{},{},{},{},{},{}\n", core::csv_cell(layer.label), cell(layer.answer.efficiency),
                   cell(layer.answer.half_width), cell(layer.speed()), cell(layer.theory),
                   layer.answer.is_inside() ? 1 : 0,
                   core::csv_cell(layer.outside(&atlas::Outside::name, " ")));
    }
}

void print_text(std::vector<PredictedLayer> const& layers) {
    std::size_t width = 4;
    for (PredictedLayer const& layer : layers) width = std::max(width, layer.label.size());
    fmt::print("{:{}}  {:>15}  {:>9}  {:>10}\n", "case", width, "eta, atlas", "speed", "eta theory");
    fmt::print("{:{}}  {:>15}  {:>9}  {:>10}\n", "", width, "95 %", "m/s", "point mass");
    for (PredictedLayer const& layer : layers) {
        std::string const efficiency =
            layer.answer.efficiency ? fmt::format("{} +- {}", core::three_digits(layer.answer.efficiency),
                                                  core::three_digits(layer.answer.half_width))
                                    : "-";
        std::string const outside = layer.outside(&atlas::Outside::why, ", ");
        fmt::print("{:{}}  {:>15}  {:>9}  {:>10}{}\n", layer.label, width, efficiency,
                   core::three_digits(layer.speed()), core::three_digits(layer.theory),
                   outside.empty() ? "" : "  outside: " + outside);
    }
    bool const is_all_inside =
        std::ranges::all_of(layers, [](PredictedLayer const& layer) { return layer.answer.is_inside(); });
    fmt::print("\nFrom {} simulated layers of spheres.{}\n", atlas::simulated_layers(),
               is_all_inside ? ""
                             : " What lies outside of them is an extrapolation, or not known at all: "
                               "simulate it.");
}

}  // namespace

void predict_layers(std::filesystem::path const& campaign_file, PredictionFormat format) {
    auto const layers = predict_all(scenario::read_campaign(campaign_file));
    if (format == PredictionFormat::json) {
        Json list = Json::array();
        for (PredictedLayer const& layer : layers) list.push_back(as_json(layer));
        fmt::print("{}\n", list.dump(2));
    } else if (format == PredictionFormat::csv) {
        print_csv(layers);
    } else {
        print_text(layers);
    }
}

}  // namespace vibrotrough::app
