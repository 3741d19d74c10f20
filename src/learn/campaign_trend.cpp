#include "learn/campaign_trend.hpp"

#include "atlas/atlas.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <cmath>

namespace vibrotrough::learn {
namespace {

/// By how much layers differ from the atlas at least; few points cannot show that it is less.
constexpr double least_difference = 0.02;
/// By how much layers differ from the atlas, which few points cannot show: layers that it had not seen do by
/// 0.03 to 0.05 (validation/atlas), of which a part is common to a domain. How far domains differ in this is
/// taken to be a factor of e^0.5 (one standard deviation).
constexpr inference::LogNormal difference_from_atlas{0.03, 0.5};
constexpr double common_difference = 0.05, difference_of_slope = 0.2;
/// The lengths over which that varies, at most, over those of the atlas' own process, which has learnt the
/// longer waves: so the surfaces of validation/decisions hold what was not simulated.
constexpr double part_of_lengths = 0.7;
/// How well they are known, and the shortest of them, in widths of the ranges.
constexpr double sd_of_lengths = 0.5, shortest_length = 0.1;
/// How far from their ends ranges are looked at, over their width: a value at an end may be none of a key.
constexpr double margin = 0.01;
/// Inputs of a surface whose corners are looked at.
constexpr std::size_t most_inputs = 8;

double within(atlas::SurfaceInput const& input, double fraction) {
    return input.low + fraction * (input.high - input.low);
}

}  // namespace

std::optional<double> theory_of(prepare::PreparedCase const& prepared) {
    auto const motion = prepare::solve(prepared.point_mass);
    if (!motion.converged && motion.outcome != theory::Outcome::unsettled) return {};
    if (!std::isfinite(motion.velocity_efficiency)) return {};
    return motion.velocity_efficiency;
}

CampaignTrend::CampaignTrend(scenario::CaseMaker maker, std::vector<atlas::SurfaceInput> inputs,
                             std::map<std::string, scenario::Content> words)
    : maker_(std::move(maker)),
      inputs_(std::move(inputs)),
      words_(std::move(words)),
      is_atlas_(is_of_atlas_kind()) {}

scenario::Scenario CampaignTrend::scenario_at(atlas::Place const& place) const {
    auto values = words_;
    for (std::size_t k = 0; k < inputs_.size(); ++k) values[inputs_[k].key] = place[k];
    return maker_.make(values);
}

std::optional<atlas::Place> CampaignTrend::atlas_place_at(atlas::Place const& place) const {
    return atlas::place_of(prepare::prepare_case(scenario_at(place)));
}

/// Whether the layers in all corners of the domain are of the atlas' kind: a varied number may change the
/// kind, as the distance of the side walls does.
bool CampaignTrend::is_of_atlas_kind() const {
    if (inputs_.size() > most_inputs) return false;
    bool is_known = false;
    for (unsigned corner = 0; corner < 1U << inputs_.size(); ++corner) {
        atlas::Place place;
        for (std::size_t k = 0; k < inputs_.size(); ++k)
            place.push_back(within(inputs_[k], (corner >> k & 1U) != 0 ? 1 - margin : margin));
        try {
            if (!atlas_place_at(place)) return false;
            is_known = true;
        } catch (core::InputError const&) {  // a corner that has no case says nothing
        }
    }
    return is_known;
}

std::optional<double> CampaignTrend::efficiency_of(prepare::PreparedCase const& prepared) const {
    if (!is_atlas_) return theory_of(prepared);
    auto const place = atlas::place_of(prepared);
    if (!place) return {};
    return atlas::efficiency_at(atlas::within_ranges(*place));
}

std::optional<double> CampaignTrend::efficiency_at(atlas::Place const& place) const {
    try {
        return efficiency_of(prepare::prepare_case(scenario_at(place)));
    } catch (core::InputError const&) {
        return {};  // values that do not go together
    }
}

atlas::SurfacePrior CampaignTrend::prior() const {
    atlas::SurfacePrior prior;
    if (!is_atlas_) return prior;
    prior.offset_sd = common_difference;
    prior.slope_sd = difference_of_slope;
    prior.about_trend.deviation = difference_from_atlas;
    auto& known = prior.about_trend.lengths;
    known.resize(inputs_.size());  // nothing of an input of which the atlas says nothing
    prior.least_deviation = least_difference;
    prior.longest.assign(inputs_.size(), atlas::usual_longest_length);
    atlas::Place middle;
    for (atlas::SurfaceInput const& input : inputs_) middle.push_back(within(input, 0.5));
    for (std::size_t k = 0; k < inputs_.size(); ++k) {
        atlas::Place low = middle, high = middle;
        low[k] = within(inputs_[k], margin);
        high[k] = within(inputs_[k], 1 - margin);
        try {
            auto const from = atlas_place_at(low), to = atlas_place_at(high);
            double const distance = from && to ? atlas::distance_between(*from, *to) : 0;
            if (!(distance > 0)) continue;
            // So many lengths of the atlas wide is the range.
            double const lengths_wide = distance / (1 - 2 * margin);
            prior.longest[k] =
                std::clamp(part_of_lengths / lengths_wide, shortest_length, atlas::usual_longest_length);
            known[k] = {prior.longest[k], sd_of_lengths};
        } catch (core::InputError const&) {  // values that do not go together: the usual length stays
        }
    }
    return prior;
}

}  // namespace vibrotrough::learn
