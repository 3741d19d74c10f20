#pragma once

#include "atlas/surface.hpp"
#include "campaign/state/plan.hpp"
#include "core/outcome.hpp"
#include "learn/campaign_trend.hpp"
#include "scenario/reader/case_maker.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::learn {

/// A case that is not a point of the surface, because its mean is not one number.
struct CaseKeptApart {
    std::string case_id;    ///< of the case
    atlas::Place place;     ///< its inputs
    core::Outcome outcome;  ///< e.g. bistable-or-slow, not-steady
};

/// The cases of a campaign as points of a surface.
struct CampaignPoints {
    std::vector<atlas::SurfaceInput> inputs;  ///< of the domain, or of the range that the cases cover
    std::vector<atlas::SurfacePoint> points;  ///< steady cases with an interval
    std::vector<CaseKeptApart> apart;         ///< bistable and unsteady ones, which are never averaged
    int missing = 0;                          ///< cases without a result
    int other_layers = 0;  ///< cases left out: they were added before another key was edited
    /// Bound, at 95 %, of the numerical error of the velocity efficiency: the largest of its cases, as
    /// studied by `convergence` or as known beforehand (prepare::numerical_errors). More cases do not make it
    /// smaller.
    double numerics = 0;
    atlas::SurfacePrior prior;  ///< of their surface, unless they contradict it (surface_of())
};

/// What the campaign file gives now for the varied keys of a scenario that was planned as the case `id`, with
/// the scenario's own `measure` and `output`; nothing when that is another layer, because another key was
/// edited since.
std::optional<scenario::Scenario> same_layer(scenario::Scenario const& scenario, std::string const& id,
                                             campaign::Plan const& plan, scenario::CaseMaker const& maker);

/// Takes the added cases of other layers out of a plan. @return how many these were
int leave_out_other_layers(campaign::Plan& plan, scenario::CaseMaker const& maker);

/// The cases of a campaign, sorted into points and what is kept apart. Cases at which the trend has no mean
/// speed, whose words differ from `words`, or that were added for another layer, are left out.
/// @throws core::InputError when no number is varied, or cases differ in a word that `words` does not give
CampaignPoints campaign_points(campaign::Plan const& plan, scenario::CaseMaker const& maker,
                               std::map<std::string, scenario::Content> const& words = {});

/// The surface over the points. Where they differ from the atlas by more than 1.4 times what layers do, what
/// is known of that difference may not hold for them: then its least size alone is taken, and the longest
/// lengths over which it varies.
/// @throws core::InputError as Surface
atlas::Surface surface_of(CampaignPoints const& points);

/// Whether the surface takes what is known of the difference from the atlas.
bool rests_on_atlas(atlas::Surface const& surface);

/// Points below which a surface is not trusted, however sure of itself it is. Ten for each input where little
/// is known of the function (J.L. Loeppky, J. Sacks and W.J. Welch, Technometrics 51 (2009) 366-376); five
/// where the difference from the atlas is (validation/decisions).
int least_points(atlas::Surface const& surface);

/// The case kept apart that lies nearer to a place than every point of the surface; nullptr when there is
/// none. Distances are in the scaled inputs.
CaseKeptApart const* nearest_kept_apart(CampaignPoints const& points, atlas::Place const& place);

}  // namespace vibrotrough::learn
