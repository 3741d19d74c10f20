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

/// Whether the words of a case are those asked for.
bool has_words(scenario::Scenario const& scenario, std::map<std::string, scenario::Content> const& words) {
    return std::ranges::all_of(words, [&](auto const& word) {
        auto const found = scenario::word_of(scenario, word.first);
        return found && scenario::Content(*found) == word.second;
    });
}

/// The theory's answer for a prepared case; nothing when the mass has no mean speed.
std::optional<double> theory_of(prepare::PreparedCase const& prepared) {
    auto const motion = prepare::solve(prepared.point_mass);
    if (!motion.converged && motion.outcome != theory::Outcome::unsettled) return {};
    if (!std::isfinite(motion.velocity_efficiency)) return {};
    return motion.velocity_efficiency;
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

scenario::Scenario CampaignTheory::scenario_at(atlas::Place const& place) const {
    auto values = words_;
    for (std::size_t k = 0; k < inputs_.size(); ++k) values[inputs_[k].key] = place[k];
    return maker_.make(values);
}

std::optional<double> CampaignTheory::efficiency_at(atlas::Place const& place) const {
    try {
        return theory_of(prepare::prepare_case(scenario_at(place)));
    } catch (core::InputError const&) {
        return {};  // values that do not go together
    }
}

CampaignPoints campaign_points(campaign::Plan const& plan, scenario::CaseMaker const& maker,
                               std::map<std::string, scenario::Content> const& words) {
    CampaignPoints found{inputs_of(plan, maker, words), {}, {}, 0};
    auto const studied = campaign::read_case_numerics(plan);
    for (campaign::PlannedCase const& planned : plan.cases) {
        require_steady_drive(planned.scenario(), "a surface");
        if (!has_words(planned.scenario(), words)) continue;
        auto const place = place_of(planned.scenario(), found.inputs);
        auto const theory = theory_of(*planned.prepared);
        if (!place || !theory) continue;
        auto const study = studied.find(planned.id);
        found.numerics = std::max(
            found.numerics, study != studied.end() ? study->second.error
                                                   : prepare::numerical_errors(planned.scenario()).total());
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
                {planned.id, *place, *theory, *record.estimate.mean, *record.estimate.half_width});
        } else {
            found.apart.push_back({planned.id, *place, record.outcome});
        }
    }
    return found;
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
