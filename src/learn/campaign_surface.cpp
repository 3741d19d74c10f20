#include "learn/campaign_surface.hpp"

#include "campaign/state/numerics_results.hpp"
#include "campaign/state/result_summary.hpp"
#include "core/error.hpp"
#include "prepare/numerical_errors.hpp"
#include "prepare/prepared_case.hpp"
#include "scenario/reader/keys.hpp"
#include "scenario/reader/swept_keys.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace vibrotrough::learn {
namespace {

/// So much more than layers differ from the atlas may be no chance.
constexpr double too_large = 1.4;

/// Whether the words of a case are those asked for.
bool has_words(scenario::Scenario const& scenario, std::map<std::string, scenario::Content> const& words) {
    return std::ranges::all_of(words, [&](auto const& word) {
        auto const found = scenario::word_of(scenario, word.first);
        return found && scenario::Content(*found) == word.second;
    });
}

std::vector<atlas::SurfaceInput> inputs_of(campaign::Plan const& plan, scenario::CaseMaker const& maker,
                                           std::map<std::string, scenario::Content> const& words) {
    std::vector<atlas::SurfaceInput> inputs;
    for (std::string const& key : maker.varied_keys()) {
        if (scenario::has_words(*scenario::find_key(key))) {
            if (words.contains(key)) continue;
            throw core::InputError(fmt::format(
                "the campaign varies {}, whose values are words; say for which one, for example --at "
                "{}=...",
                key, key));
        }
        auto const given = std::ranges::find(maker.domain(), key, &scenario::DomainAxis::key);
        if (given != maker.domain().end()) {
            inputs.push_back({key, given->low, given->high});
            continue;
        }
        atlas::SurfaceInput range{key, std::numeric_limits<double>::infinity(),
                                  -std::numeric_limits<double>::infinity()};
        for (campaign::PlannedCase const& planned : plan.cases) {
            auto const value = scenario::number_of(planned.scenario(), key);
            if (!value) continue;
            range.low = std::min(range.low, *value);
            range.high = std::max(range.high, *value);
        }
        if (range.low < range.high) inputs.push_back(range);
    }
    if (inputs.empty())
        throw core::InputError(
            "the campaign varies no number, so that there is no surface; vary one in [sweep] or [domain]");
    return inputs;
}

/// The inputs of a case; nothing when one has no number.
std::optional<atlas::Place> place_of(scenario::Scenario const& scenario,
                                     std::vector<atlas::SurfaceInput> const& inputs) {
    atlas::Place place;
    for (atlas::SurfaceInput const& input : inputs) {
        auto const value = scenario::number_of(scenario, input.key);
        if (!value) return {};
        place.push_back(*value);
    }
    return place;
}

double distance(atlas::Place const& a, atlas::Place const& b,
                std::vector<atlas::SurfaceInput> const& inputs) {
    double sum = 0;
    for (std::size_t k = 0; k < inputs.size(); ++k)
        sum += std::pow((a[k] - b[k]) / (inputs[k].high - inputs[k].low), 2);
    return std::sqrt(sum);
}

}  // namespace

std::optional<scenario::Scenario> same_layer(scenario::Scenario const& scenario, std::string const& id,
                                             campaign::Plan const& plan, scenario::CaseMaker const& maker) {
    std::map<std::string, scenario::Content> values;
    for (std::string const& key : maker.varied_keys())
        if (auto const value = scenario::key_value(scenario, key)) values[key] = *value;
    try {
        auto now = maker.make(values);
        // How precisely a layer is measured, and what is stored of it, does not make it another one.
        now.measure = scenario.measure;
        now.output = scenario.output;
        if (campaign::plan_case(now, plan.folder, plan.engine_version).id == id) return now;
    } catch (core::InputError const&) {  // values that do not go together any more
    }
    return {};
}

int leave_out_other_layers(campaign::Plan& plan, scenario::CaseMaker const& maker) {
    return static_cast<int>(std::erase_if(plan.cases, [&](campaign::PlannedCase const& one) {
        return one.is_added && !same_layer(one.scenario(), one.id, plan, maker);
    }));
}

CampaignPoints campaign_points(campaign::Plan const& plan, scenario::CaseMaker const& maker,
                               std::map<std::string, scenario::Content> const& words) {
    campaign::Plan known = plan;
    int const other_layers = leave_out_other_layers(known, maker);
    CampaignTrend const trend(maker, inputs_of(known, maker, words), words);
    CampaignPoints found{trend.inputs(), {}, {}, 0, other_layers, 0, trend.prior()};
    auto const studied = campaign::read_case_numerics(known.folder);
    for (campaign::PlannedCase const& planned : known.cases) {
        require_steady_drive(planned.scenario(), "a surface");
        if (!has_words(planned.scenario(), words)) continue;
        auto const place = place_of(planned.scenario(), found.inputs);
        auto const value = place ? trend.efficiency_of(*planned.prepared) : std::nullopt;
        if (!value) continue;
        auto const study = studied.find(planned.id);
        found.numerics = std::max(
            found.numerics,
            study != studied.end() ? study->second : prepare::numerical_errors(planned.scenario()).total());
        auto const summary = campaign::find_summary(planned);
        if (!summary) {
            ++found.missing;
            continue;
        }
        auto const& record = summary->record;
        bool const steady =
            record.outcome == core::Outcome::finished || record.outcome == core::Outcome::not_precise;
        if (steady && record.estimate.mean && record.estimate.half_width) {
            found.points.push_back(
                {planned.id, *place, *value, *record.estimate.mean, *record.estimate.half_width});
        } else {
            found.apart.push_back({planned.id, *place, record.outcome});
        }
    }
    return found;
}

atlas::Surface surface_of(CampaignPoints const& points) {
    atlas::Surface surface(points.inputs, points.points, points.prior);
    auto const& known = points.prior.about_trend.deviation;
    if (!known) return surface;
    inference::Hyperparameters const& found = surface.process().hyperparameters();
    if (std::hypot(found.deviation, found.extra_noise) <= too_large * known->median) return surface;
    atlas::SurfacePrior careful;
    careful.least_deviation = points.prior.least_deviation;
    careful.longest = points.prior.longest;
    return {points.inputs, points.points, careful};
}

bool rests_on_atlas(atlas::Surface const& surface) {
    return !surface.prior().about_trend.lengths.empty();
}

int least_points(atlas::Surface const& surface) {
    int const of_input = rests_on_atlas(surface) ? 5 : 10;
    return of_input * static_cast<int>(surface.inputs().size());
}

CaseKeptApart const* nearest_kept_apart(CampaignPoints const& points, atlas::Place const& place) {
    double nearest = std::numeric_limits<double>::infinity();
    for (atlas::SurfacePoint const& point : points.points)
        nearest = std::min(nearest, distance(point.place, place, points.inputs));
    CaseKeptApart const* found = nullptr;
    for (CaseKeptApart const& one : points.apart) {
        double const d = distance(one.place, place, points.inputs);
        if (d >= nearest) continue;
        nearest = d;
        found = &one;
    }
    return found;
}

}  // namespace vibrotrough::learn
