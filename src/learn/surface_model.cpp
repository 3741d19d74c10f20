#include "learn/surface_model.hpp"

#include "core/error.hpp"
#include "learn/machine_keys.hpp"
#include "scenario/reader/swept_keys.hpp"
#include "scenario/reader/written_campaign.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::learn {
namespace {

/// The machine as it was set for a measurement whose vibration angle is known.
theory::Drive drive_of(MeasuredSpeed const& m) {
    return {m.frequency, m.amplitude, *m.vibration_angle, m.inclination.value_or(0)};
}

/// The machine of a case must be that of the measurement.
void check_machine(scenario::Scenario const& scenario, MeasuredSpeed const& m) {
    struct Quantity {
        char const* name;
        double campaign, measured, tolerance, in_unit;
        char const* unit;
    };
    scenario::Trough const& t = scenario.trough;
    // A quarter of a degree, and two percent: as well as machines are usually known.
    for (Quantity const& q : {Quantity{"amplitude", t.amplitude, m.amplitude, 0.02 * m.amplitude, 1e3, "mm"},
                              Quantity{"frequency", t.frequency, m.frequency, 0.02 * m.frequency, 1, "Hz"},
                              Quantity{"vibration angle", t.vibration_angle, *m.vibration_angle, degree / 4,
                                       1 / degree, "degrees"},
                              Quantity{"inclination", t.inclination, m.inclination.value_or(0), degree / 4,
                                       1 / degree, "degrees"}}) {
        if (std::abs(q.campaign - q.measured) <= q.tolerance) continue;
        throw core::InputError(
            fmt::format("line {}: the {} is {:.4g} {} and that of the campaign {:.4g} {}; simulate the "
                        "machine that was measured, or vary this key",
                        m.line, q.name, q.in_unit * q.measured, q.unit, q.in_unit * q.campaign, q.unit));
    }
}

/// Where each input of the surface comes from: a free parameter, or the measurement.
struct Source {
    std::optional<std::size_t> parameter;
    scenario::Key const* machine;
};

atlas::Place place_from(std::vector<Source> const& sources, std::span<double const> values,
                        MeasuredSpeed const& measured) {
    atlas::Place place;
    for (Source const& source : sources)
        place.push_back(source.parameter ? values[*source.parameter]
                                         : value_at(*source.machine, drive_of(measured)));
    return place;
}

class SurfaceModel {
  public:
    SurfaceModel(std::shared_ptr<atlas::Surface const> surface, CampaignTrend trend,
                 std::vector<Source> sources, double numerics)
        : surface_(std::move(surface)),
          trend_(std::move(trend)),
          sources_(std::move(sources)),
          numerics_(numerics) {}

    atlas::Place place(std::span<double const> values, MeasuredSpeed const& measured) const {
        return place_from(sources_, values, measured);
    }

    std::optional<ModelSpeed> operator()(std::span<double const> values,
                                         MeasuredSpeed const& measured) const {
        atlas::Place const at = place(values, measured);
        auto const trend = trend_.efficiency_at(at);
        if (!trend) return {};
        auto const [efficiency, half_width] = surface_->at(at, *trend);
        double const trough_speed = drive_of(measured).trough_speed();
        double const sd = std::hypot(half_width, numerics_) / atlas::deviations_in_half_width;
        return ModelSpeed{efficiency * trough_speed, sd * trough_speed, trough_speed, 0};
    }

    CampaignTrend const& trend() const { return trend_; }

  private:
    std::shared_ptr<atlas::Surface const> surface_;
    CampaignTrend trend_;
    std::vector<Source> sources_;
    double numerics_;  ///< 95 % bound, in velocity efficiency
};

std::vector<Source> sources_of(std::vector<atlas::SurfaceInput> const& inputs,
                               std::vector<std::string> const& free) {
    std::vector<Source> sources;
    for (atlas::SurfaceInput const& input : inputs) {
        auto const found = std::ranges::find(free, input.key);
        if (found != free.end()) {
            sources.push_back({static_cast<std::size_t>(found - free.begin()), nullptr});
        } else if (scenario::Key const* const machine = machine_key(input.key)) {
            sources.push_back({{}, machine});
        } else {
            throw core::InputError(fmt::format(
                "the campaign varies {}, which the measurements do not give; add it to --free", input.key));
        }
    }
    for (std::string const& name : free) {
        if (std::ranges::find(inputs, name, &atlas::SurfaceInput::key) == inputs.end())
            throw core::InputError(fmt::format("--free {}: the campaign does not vary it", name));
        if (machine_key(name) != nullptr)
            throw core::InputError(
                fmt::format("--free {}: the measurements give it; free another input", name));
    }
    return sources;
}

}  // namespace

std::vector<FreeParameter> surface_parameters(std::vector<atlas::SurfaceInput> const& inputs) {
    std::vector<FreeParameter> parameters;
    for (atlas::SurfaceInput const& input : inputs) {
        if (machine_key(input.key) != nullptr) continue;
        std::string const unit(scenario::find_key(input.key)->unit);
        parameters.push_back({input.key, unit.empty() ? "1" : unit, {input.low, input.high}});
    }
    return parameters;
}

CalibrationModel surface_model(std::shared_ptr<atlas::Surface const> surface,
                               scenario::CaseMaker const& maker, std::vector<std::string> const& free,
                               std::vector<MeasuredSpeed> const& speeds, double numerics) {
    auto const inputs = surface->inputs();
    SurfaceModel const model(std::move(surface), CampaignTrend(maker, inputs, {}), sources_of(inputs, free),
                             numerics);
    std::vector<double> middle;
    for (std::string const& name : free) {
        auto const input = std::ranges::find(inputs, name, &atlas::SurfaceInput::key);
        middle.push_back((input->low + input->high) / 2);
    }
    for (MeasuredSpeed const& m : speeds) {
        if (!m.vibration_angle)
            throw core::InputError(
                fmt::format("line {} has no vibration angle; write the column vibration_angle_deg", m.line));
        atlas::Place const place = model.place(middle, m);
        check_machine(model.trend().scenario_at(place), m);
        for (std::size_t k = 0; k < inputs.size(); ++k) {
            double const margin = 0.02 * (inputs[k].high - inputs[k].low);
            if (place[k] >= inputs[k].low - margin && place[k] <= inputs[k].high + margin) continue;
            auto const text = [&](double value) {
                return scenario::written_value(*scenario::find_key(inputs[k].key), value);
            };
            throw core::InputError(fmt::format(
                "line {}: {} is {} there, outside the range {} to {} of the campaign; simulate it, too",
                m.line, inputs[k].key, text(place[k]), text(inputs[k].low), text(inputs[k].high)));
        }
    }
    return model;
}

std::vector<atlas::Place> posterior_places(std::vector<atlas::SurfaceInput> const& inputs,
                                           std::vector<std::string> const& free,
                                           Calibration const& calibration,
                                           std::vector<MeasuredSpeed> const& speeds) {
    constexpr std::size_t most_draws = 40;
    auto const sources = sources_of(inputs, free);
    std::size_t const draws = calibration.parameters.front().draws.size();
    std::size_t const step = std::max<std::size_t>(1, draws / most_draws);
    std::vector<atlas::Place> places;
    for (std::size_t i = step / 2; i < draws; i += step) {
        std::vector<double> values;
        for (Estimate const& e : calibration.parameters) values.push_back(e.draws[i]);
        for (MeasuredSpeed const& measured : speeds) places.push_back(place_from(sources, values, measured));
    }
    return places;
}

}  // namespace vibrotrough::learn
