#include "app/commands/predict_layers.hpp"

#include "app/commands/command.hpp"
#include "atlas/atlas.hpp"
#include "atlas/layer_load.hpp"
#include "atlas/layer_mode.hpp"
#include "atlas/tables.hpp"
#include "core/text.hpp"
#include "prepare/prepared_case.hpp"
#include "scenario/reader/campaign_file.hpp"
#include "scenario/reader/swept_keys.hpp"

namespace vibrotrough::app {
namespace {

/// What the atlas says of one case.
struct PredictedLayer {
    std::string label;             ///< what distinguishes it from the others of its campaign
    atlas::Answer answer;          ///< of the atlas
    std::optional<double> theory;  ///< velocity efficiency of the point mass
    double velocity_scale;         ///< m/s
    std::optional<atlas::LayerLoad> load;
    std::optional<atlas::LikelyMode> mode;
    std::optional<atlas::Bounded> power;  ///< W/m^2 of trough
    std::optional<int> later;             ///< atlas::repeating_later()
    std::optional<double> speed() const {
        return answer.efficiency ? std::optional(*answer.efficiency * velocity_scale) : std::nullopt;
    }
    /// Of the simulated layers that are most alike, those that move so.
    std::optional<double> mode_share() const {
        return mode ? std::optional(static_cast<double>(mode->agreeing) / atlas::layers_asked) : std::nullopt;
    }
    std::optional<double> later_share() const {
        return later ? std::optional(static_cast<double>(*later) / atlas::layers_asked_for_period)
                     : std::nullopt;
    }
    std::string outside(std::string atlas::Outside::*part, std::string_view separator) const {
        std::vector<std::string> texts;
        for (atlas::Outside const& one : answer.outside) texts.push_back(one.*part);
        return fmt::format("{}", fmt::join(texts, separator));
    }
};

/// W/m^2, the mean power of the trough on a layer; none where the atlas does not know it.
std::optional<atlas::Bounded> power_per_area(atlas::LayerLoad const& load,
                                             prepare::PreparedCase const& prepared,
                                             std::optional<atlas::Bounded> const& fed_depth) {
    scenario::Scenario const& s = prepared.scenario;
    auto const power = power_per_mass(load, s.trough.amplitude, s.trough.frequency);
    if (!power) return {};
    auto const [value, half_width] = *power;
    double const mass_per_area = fed_depth ? bulk_density(s.grains) * fed_depth->value
                                           : prepared.mass / (s.layer.length * s.layer.width);
    // The depth follows from the same speed as everything else, so that its error is not independent.
    double const by_depth = fed_depth ? value * bulk_density(s.grains) * fed_depth->half_width : 0;
    return atlas::Bounded{mass_per_area * value, mass_per_area * half_width + by_depth};
}

PredictedLayer predict_layer(prepare::PreparedCase const& prepared, std::string const& label) {
    auto const motion = prepare::solve(prepared.point_mass);
    PredictedLayer layer{label,
                         atlas::predict(prepared),
                         motion.converged ? std::optional(motion.velocity_efficiency) : std::nullopt,
                         prepared.velocity_scale,
                         {},
                         {},
                         {},
                         {}};
    if (layer.answer.place) {
        layer.load = atlas::load_at(*layer.answer.place);
        layer.mode = atlas::mode_at(*layer.answer.place);
        layer.later = atlas::repeating_later((*layer.answer.place)[atlas::throw_number_input]);
        layer.power = power_per_area(*layer.load, prepared, layer.answer.fed_depth);
    }
    return layer;
}

std::vector<PredictedLayer> predict_all(scenario::Campaign const& campaign) {
    std::vector<PredictedLayer> layers;
    for (scenario::Scenario const& scenario : campaign.cases) {
        std::string const label = swept_label(scenario, campaign.swept);
        layers.push_back(
            predict_layer(prepare::prepare_case(scenario), label.empty() ? campaign.name : label));
    }
    return layers;
}

/// From so many layers on that repeat only after several cycles it is told.
constexpr int remarkable = atlas::layers_asked_for_period / 5;

/// What is told of a layer in words: how deep its feed makes it, and what lies outside.
std::string remarks(PredictedLayer const& layer) {
    std::string text;
    if (auto const& depth = layer.answer.fed_depth)
        text = fmt::format("  fed: {:.3g} +- {:.2g} mm deep", 1e3 * depth->value, 1e3 * depth->half_width);
    if (layer.later.value_or(0) >= remarkable)
        text += fmt::format(
            "  may repeat only after several cycles, as {} of {} layers near this throw number do",
            *layer.later, atlas::layers_asked_for_period);
    if (layer.load && !layer.power)
        text += "  no power: the surface over the simulated layers is negative here";
    std::string const outside = layer.outside(&atlas::Outside::why, ", ");
    return outside.empty() ? text : text + "  outside: " + outside;
}

/// What is told of a layer beside its efficiency, in the order of columns and members.
std::vector<std::pair<char const*, std::optional<double>>> load_of(PredictedLayer const& layer) {
    std::vector<std::pair<char const*, std::optional<double>>> all;
    auto const add = [&](char const* name, char const* half_width, std::optional<atlas::Bounded> const& one) {
        all.emplace_back(name, one ? std::optional(one->value) : std::nullopt);
        all.emplace_back(half_width, one ? std::optional(one->half_width) : std::nullopt);
    };
    auto const part = [&](atlas::Bounded atlas::LayerLoad::*of) {
        return layer.load ? std::optional((*layer.load).*of) : std::nullopt;
    };
    add("added_mass_fraction", "added_mass_fraction_half_width", part(&atlas::LayerLoad::added_mass));
    add("damping", "damping_half_width", layer.power ? part(&atlas::LayerLoad::damping) : std::nullopt);
    add("power_per_area_w_per_m2", "power_per_area_half_width_w_per_m2", layer.power);
    add("fed_depth_m", "fed_depth_half_width_m", layer.answer.fed_depth);
    return all;
}

Json as_json(PredictedLayer const& layer) {
    Json names = Json::array();
    for (atlas::Outside const& one : layer.answer.outside) names.push_back(one.name);
    Json json{{"case", layer.label},
              {"efficiency", number_or_null(layer.answer.efficiency)},
              {"half_width", number_or_null(layer.answer.half_width)},
              {"speed_m_per_s", number_or_null(layer.speed())},
              {"efficiency_theory", number_or_null(layer.theory)},
              {"inside", layer.answer.is_inside()},
              {"outside", names}};
    for (auto const& [name, value] : load_of(layer)) json[name] = number_or_null(value);
    json["layer_mode"] = layer.mode ? Json(layer.mode->mode) : Json(nullptr);
    json["layer_mode_share"] = number_or_null(layer.mode_share());
    json["several_cycles_share"] = number_or_null(layer.later_share());
    return json;
}

std::string with_half_width(std::optional<double> value, std::optional<double> half_width) {
    if (!value) return "-";
    return fmt::format("{} +- {}", core::three_digits(value), core::three_digits(half_width));
}

std::string bounded(std::optional<atlas::Bounded> const& one) {
    return one ? with_half_width(one->value, one->half_width) : "-";
}

std::string mode_cell(PredictedLayer const& layer) {
    return layer.mode ? fmt::format("{} {}", layer.mode->mode, layer.mode->agreeing) : "-";
}

void print_text(std::vector<PredictedLayer> const& layers) {
    std::size_t width = 4;
    for (PredictedLayer const& layer : layers) width = std::max(width, layer.label.size());
    constexpr char const* line = "{:{}}  {:>15}  {:>9}  {:>10}  {:>13}  {:>14}  {:>9}{}\n";
    fmt::print(fmt::runtime(line), "case", width, "eta, atlas", "speed", "eta theory", "power", "added mass",
               "mode", "");
    fmt::print(fmt::runtime(line), "", width, "95 %", "m/s", "point mass", "W/m2, 95 %", "share, 95 %",
               "of 5", "");
    for (PredictedLayer const& layer : layers) {
        auto const& added = layer.load ? std::optional(layer.load->added_mass) : std::nullopt;
        fmt::print(fmt::runtime(line), layer.label, width,
                   with_half_width(layer.answer.efficiency, layer.answer.half_width),
                   core::three_digits(layer.speed()), core::three_digits(layer.theory), bounded(layer.power),
                   bounded(added), mode_cell(layer), remarks(layer));
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
    std::vector<Json> rows;
    for (PredictedLayer const& layer : layers) rows.push_back(as_json(layer));
    if (format == PredictionFormat::json) {
        fmt::print("{}\n", Json(rows).dump(2));
    } else if (format == PredictionFormat::csv) {
        print_csv(rows);
    } else {
        print_text(layers);
    }
}

}  // namespace vibrotrough::app
