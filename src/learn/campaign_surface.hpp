#pragma once

#include "atlas/surface.hpp"
#include "campaign/state/plan.hpp"
#include "core/outcome.hpp"
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
    /// Bound, at 95 %, of the numerical error of the velocity efficiency: the largest of its cases, as
    /// studied by `convergence` or as known beforehand (prepare::numerical_errors). More cases do not make it
    /// smaller.
    double numerics = 0;
};

/// Velocity efficiencies of the theory over the inputs of a campaign.
class CampaignTheory {
  public:
    /// @param words  values of varied keys that are words, such as grains.rotation; the same everywhere
    CampaignTheory(scenario::CaseMaker maker, std::vector<atlas::SurfaceInput> inputs,
                   std::map<std::string, scenario::Content> words)
        : maker_(std::move(maker)), inputs_(std::move(inputs)), words_(std::move(words)) {}

    /// The case at a place. @throws core::InputError when there is none
    scenario::Scenario scenario_at(atlas::Place const& place) const;
    /// Velocity efficiency of the plastic point mass at a place; nothing when it has no mean speed, or the
    /// place has no case.
    std::optional<double> efficiency_at(atlas::Place const& place) const;

    std::vector<atlas::SurfaceInput> const& inputs() const { return inputs_; }  ///< of the surface

  private:
    scenario::CaseMaker maker_;
    std::vector<atlas::SurfaceInput> inputs_;
    std::map<std::string, scenario::Content> words_;
};

/// The cases of a campaign, sorted into points and what is kept apart. Cases at which the theory has no mean
/// speed, or whose words differ from `words`, are left out.
/// @throws core::InputError when no number is varied, or cases differ in a word that `words` does not give
CampaignPoints campaign_points(campaign::Plan const& plan, scenario::CaseMaker const& maker,
                               std::map<std::string, scenario::Content> const& words = {});

/// The case kept apart that lies nearer to a place than every point of the surface; nullptr when there is
/// none. Distances are in the scaled inputs.
CaseKeptApart const* nearest_kept_apart(CampaignPoints const& points, atlas::Place const& place);

}  // namespace vibrotrough::learn
