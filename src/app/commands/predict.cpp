#include "app/commands/command.hpp"
#include "app/commands/predict_machine.hpp"
#include "app/learning.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "core/outcome.hpp"
#include "learn/campaign_surface.hpp"
#include "scenario/reader/swept_keys.hpp"

#include <sstream>
#include <tuple>

namespace vibrotrough::app {
namespace {

struct PredictArguments {
    std::string folder;
    std::vector<std::string> places;
    MachineOptions machine;
    bool json = false, csv = false, without_theory = false;

    PredictionFormat format() const {
        return json ? PredictionFormat::json : csv ? PredictionFormat::csv : PredictionFormat::text;
    }
};

/// The settings of "a=1,b=2".
std::vector<std::string> settings_of(std::string const& text) {
    std::vector<std::string> settings;
    std::stringstream rest(text);
    for (std::string setting; std::getline(rest, setting, ',');) settings.push_back(setting);
    return settings;
}

/// The words among the values, which choose the cases of the surface.
std::map<std::string, scenario::Content> words_among(std::map<std::string, scenario::Content> const& values) {
    auto words = values;
    std::erase_if(words, [](auto const& one) { return std::holds_alternative<double>(one.second); });
    return words;
}

/// What is predicted at a place.
struct Prediction {
    std::vector<atlas::SurfaceInput> inputs;
    atlas::Place place;
    atlas::SurfaceValue value;
    double numerics;    ///< bound of the numerical error of the campaign's cases, 95 %
    double theory;      ///< velocity efficiency of the point mass
    std::string trend;  ///< of the surface: atlas, theory or constant
    bool is_inside;
    std::string remark;  ///< why it should not be used, or only with care; empty otherwise
    atlas::SurfaceQuality quality;

    double whole_half_width() const { return std::hypot(value.half_width, numerics); }
};

/// A value of a key in the unit that people write.
std::string as_written(std::string const& key, double value) {
    return scenario::written_value(*scenario::find_key(key), value);
}

atlas::Place numbers_at(std::map<std::string, scenario::Content> const& values,
                        std::vector<atlas::SurfaceInput> const& inputs, std::string const& text) {
    atlas::Place place;
    for (atlas::SurfaceInput const& input : inputs) {
        auto const found = values.find(input.key);
        if (found == values.end()) {
            throw core::InputError(fmt::format(
                "--at {0}: has no {1}, which the campaign varies; write for example \"{0},{1}={2}\"", text,
                input.key, as_written(input.key, (input.low + input.high) / 2)));
        }
        place.push_back(std::get<double>(found->second));
    }
    return place;
}

std::string remarks(atlas::Surface const& surface, learn::CampaignPoints const& points,
                    atlas::Place const& place, bool is_inside) {
    std::vector<std::string> all;
    if (!is_inside) all.emplace_back("The place lies outside the range of the campaign.");
    if (auto const* apart = learn::nearest_kept_apart(points, place)) {
        all.push_back(fmt::format("The nearest case, {}, ended as {} and is not part of the surface.",
                                  apart->case_id, name_of(apart->outcome)));
    }
    for (std::string const& doubt : surface.doubts()) all.push_back(doubt);
    return fmt::format("{}", fmt::join(all, " "));
}

/// A surface over the cases that are alike in the words among their keys.
struct FittedSurface {
    FittedSurface(campaign::Plan const& plan, scenario::CaseMaker const& maker,
                  std::map<std::string, scenario::Content> const& words, bool with_trend)
        : points(learn::campaign_points(plan, maker, words)),
          trend(maker, points.inputs, words),
          surface(with_trend ? learn::surface_of(points)
                             : atlas::Surface(points.inputs, points.points,
                                              atlas::SurfacePrior{.trend = atlas::Trend::constant})) {
        tell_of_other_layers(points.other_layers);
    }

    learn::CampaignPoints points;
    learn::CampaignTrend trend;
    atlas::Surface surface;
};

/// Predicts the efficiency at places of one campaign; each surface is fitted once.
class Predictor {
  public:
    explicit Predictor(PredictArguments const& options)
        : plan_(campaign::open_plan(options.folder)),
          maker_(std::filesystem::path(options.folder) / "campaign.toml"),
          with_trend_(!options.without_theory) {}

    Prediction at(std::string const& text) {
        auto const values = read_place(settings_of(text), maker_);
        auto const& [points, trend, surface] = surface_of(words_among(values));
        atlas::Place const place = numbers_at(values, points.inputs, text);
        auto const prepared = prepare::prepare_case(trend.scenario_at(place));
        auto const theory = learn::theory_of(prepared), efficiency = trend.efficiency_of(prepared);
        if (!theory || !efficiency)
            throw core::InputError(
                fmt::format("--at {}: the theory has no mean speed there, and neither has the surface; "
                            "choose another place",
                            text));
        bool is_inside = true;
        for (std::size_t k = 0; k < place.size(); ++k)
            is_inside = is_inside && place[k] >= points.inputs[k].low && place[k] <= points.inputs[k].high;
        return {.inputs = points.inputs,
                .place = place,
                .value = surface.at(place, *efficiency),
                .numerics = points.numerics,
                .theory = *theory,
                .trend = !with_trend_       ? "constant"
                         : trend.is_atlas() ? "atlas"
                                            : "theory",
                .is_inside = is_inside,
                .remark = remarks(surface, points, place, is_inside),
                .quality = surface.quality()};
    }

  private:
    FittedSurface const& surface_of(std::map<std::string, scenario::Content> const& words) {
        auto const found = surfaces_.find(words);
        if (found != surfaces_.end()) return found->second;
        return surfaces_
            .emplace(std::piecewise_construct, std::forward_as_tuple(words),
                     std::forward_as_tuple(plan_, maker_, words, with_trend_))
            .first->second;
    }

    campaign::Plan plan_;
    scenario::CaseMaker maker_;
    bool with_trend_;
    std::map<std::map<std::string, scenario::Content>, FittedSurface> surfaces_;
};

Json as_json(Prediction const& p) {
    Json at = Json::object();
    for (std::size_t k = 0; k < p.place.size(); ++k) at[p.inputs[k].key] = p.place[k];
    return {{"at", at},
            {"efficiency", p.value.efficiency},
            {"half_width", p.value.half_width},
            {"numerical_error", p.numerics},
            {"whole_half_width", p.whole_half_width()},
            {"efficiency_theory", p.theory},
            {"trend", p.trend},
            {"inside", p.is_inside},
            {"remark", p.remark},
            {"points", p.quality.points},
            {"q2", p.quality.q2},
            {"covered", p.quality.covered}};
}

/// The same as a line of a table.
Json as_row(Prediction const& p) {
    Json const all = as_json(p);
    Json row = all["at"];
    for (char const* const name :
         {"efficiency", "half_width", "numerical_error", "whole_half_width", "efficiency_theory", "inside"})
        row[name] = all[name];
    return row;
}

void print_text(Prediction const& p) {
    for (std::size_t k = 0; k < p.place.size(); ++k)
        fmt::print("{} = {}  ", p.inputs[k].key, as_written(p.inputs[k].key, p.place[k]));
    fmt::print(
        "\nvelocity efficiency  {:.3f} +- {:.3f}, of which statistics {:.3f} and numerical errors {:.3f} "
        "(theory "
        "{:.3f})\n",
        p.value.efficiency, p.whole_half_width(), p.value.half_width, p.numerics, p.theory);
    fmt::print(
        "surface              {} points, trend: {}, Q2 = {:.3f}, {} of {} left-out points within their 95 % "
        "intervals\n",
        p.quality.points, p.trend, p.quality.q2, p.quality.covered, p.quality.points);
    if (!p.remark.empty()) fmt::print("{}\n", p.remark);
}

void predict_places(PredictArguments const& options) {
    Predictor predictor(options);
    std::vector<Prediction> predictions;
    for (std::string const& place : options.places) predictions.push_back(predictor.at(place));
    if (options.json) {
        Json json = Json::array();
        for (Prediction const& p : predictions) json.push_back(as_json(p));
        fmt::print("{}\n", (json.size() == 1 ? json.front() : json).dump(2));
    } else if (options.csv) {
        std::vector<Json> rows;
        for (Prediction const& p : predictions) rows.push_back(as_row(p));
        print_csv(rows);
    } else {
        for (Prediction const& p : predictions) print_text(p);
    }
}

int run_predict(PredictArguments options) {
    if (options.folder.empty() == !options.machine.is_any())
        throw core::InputError(
            "predict needs either a campaign or a machine: write for example vibrotrough predict "
            "campaign.toml, "
            "or vibrotrough predict --rpm 960 --stroke \"8 mm\" --vibration-angle \"30 deg\" --friction 0.3");
    if (options.machine.is_any()) {
        if (!options.places.empty())
            throw core::InputError(
                "--at: belongs to a campaign with results; write its folder, or leave it out");
        return options.machine.predict(options.format()) ? all_well : some_cases_failed;
    }
    std::filesystem::path const given(options.folder);
    if (options.places.empty())
        predict_layers(std::filesystem::is_directory(given) ? given / "campaign.toml" : given,
                       options.format());
    else
        predict_places(options);
    return all_well;
}

}  // namespace

void add_predict(CLI::App& program, int& exit_code) {
    CLI::App* const command = program.add_subcommand(
        "predict", "Predict speed and mass flow of a machine, or the efficiency of a campaign's layers");
    auto const options = std::make_shared<PredictArguments>();
    command->add_option(
        "CAMPAIGN", options->folder,
        "Campaign file or folder of a campaign: its cases, from the atlas of simulated layers; "
        "with --at the folder of a campaign with results");
    options->machine.add_to(*command);
    add_repeated(*command, "--at", options->places,
                 "A place between the cases of the campaign, from their results: values of all keys that it "
                 "varies; repeat the option for several places",
                 "KEY=VALUE[,KEY=VALUE...]");
    auto* const json =
        command->add_flag("--json", options->json, "Print JSON: a list; an object for a single place");
    command->add_flag("--csv", options->csv, "Print CSV")->excludes(json);
    command->add_flag("--without-theory", options->without_theory,
                      "Leave atlas and theory out of the surface, to see how much they help");
    command->footer(
        R"(With a machine: its conveying speed and mass flow, with 95 % intervals, from the atlas of simulated layers, the most
frequent motion (mode), the point mass beside it, and why the two differ. Of grains that do not roll (a rolling friction
of 0.5 or more) the point mass decides. What is not given is in the middle of what was simulated, and the interval holds
what it may change. The exit code is 1 where no model knows the layer.

With a campaign, without --at: what the atlas says of each case of the campaign, before anything is simulated. The atlas is a
surface over layers of spheres that were simulated once for all (validation/atlas). It prints the velocity efficiency
with the half-width of its 95 % interval, the speed, the point mass beside it, the mean power that the trough gives to
the layer, the share of the layer's mass that moves with the trough, and the most frequent motion (mode) among the five
simulated layers that are most alike (F flight, P slide forwards, N slide backwards, R rest; ' right after a landing).
It names what of a case lies outside of the atlas: a layer of another kind has no prediction; one beyond the ranges of
the atlas is an extrapolation, up to a quarter of a range (of the depth's logarithm). The layer of an open trough is
as deep as its feed makes it: mass flow over bulk density, width and speed (smooth side walls count as none). JSON has
a list with case, efficiency, half_width, speed_m_per_s, efficiency_theory, inside, outside (names), and
added_mass_fraction, damping (over mass of the layer times omega), power_per_area_w_per_m2 and fed_depth_m, each with
its half-width, layer_mode with layer_mode_share, and several_cycles_share: the share of layers that repeat only after
several cycles, among the 25 whose throw numbers are nearest (the text mentions it from a fifth on).

With --at: fits a Gaussian process to the cases of the campaign that have a result. Its trend is the atlas, at the
nearest place within its ranges, or the theory for layers of a kind that the atlas does not cover; only the difference
of the layers from it is learnt. Prints the velocity efficiency at a place with the half-width of its
95 % interval, and the two parts of it: statistics (half_width in JSON and CSV), and the bound of the numerical errors of
the cases (numerical_error, the largest of them: soft grains, a small box, the time step), which more cases do not make
smaller. Both together are the root of the sum of their squares (whole_half_width). Q2 tells how well each case is
predicted from all others (1: perfectly, 0: no better than the mean). Cases that are bistable or not steady are not part
of the surface, and a place near them is marked.

A key may be written without its section where no other varied key has the same name. Quantities have units as in the
campaign file; bare numbers are SI.

Examples:
  vibrotrough predict --rpm 1000 --stroke "8 mm" --vibration-angle "25 deg" --friction 0.3
  vibrotrough predict --rpm 960 --stroke "8 mm" --vibration-angle "30 deg" --friction 0.3+-0.03 \
      --width "400 mm" --layer-depth "40 mm" --bulk-density "600 kg/m3" --grain-diameter "4 mm"
  vibrotrough predict campaign.toml
  vibrotrough predict runs/demo --at throw_number=1.9)");
    command->callback([options, &exit_code] { exit_code = run_predict(*options); });
}

}  // namespace vibrotrough::app
