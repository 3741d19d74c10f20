#pragma once

#include "campaign/state/plan.hpp"
#include "learn/campaign_surface.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::learn {

/// What a surface is to become, and what it may cost.
struct LearnGoal {
    double half_width;  ///< largest 95 % half-width of the velocity efficiency in the domain, > 0
    double budget;      ///< core-seconds of all packings together, > 0
    int batch = 2;      ///< cases that are chosen at once, >= 1
};

/// How well a surface is known over its domain.
struct DomainCertainty {
    atlas::Place worst;            ///< where the half-width is largest
    double worst_theory;           ///< velocity efficiency of the trend there
    atlas::SurfaceValue at_worst;  ///< of the surface there
    double mean_half_width;        ///< root of the mean squared half-width
};

/// Where learning stands.
struct LearnStatus {
    int cases;                        ///< of the campaign that are points of the surface
    int apart;                        ///< that are kept apart
    int least_points;                 ///< least_points() in campaign_surface.hpp
    DomainCertainty certainty;        ///< of the domain
    atlas::SurfaceQuality quality;    ///< of the surface
    std::vector<std::string> doubts;  ///< see Surface::doubts()
    double core_time;                 ///< s, spent on all results
    double core_time_to_go;           ///< s, forecast: the cost grows as the square of the precision
    /// Whether the trend is the atlas, and the layers differ from it by more than others do.
    bool contradicts_atlas = false;
};

/// A step of learning: a case at a new place, or a narrower interval of a case that is there.
struct LearnStep {
    std::optional<scenario::Scenario> added;  ///< a new case
    std::string case_id;                      ///< of a case that goes on; empty for a new one
    double half_width;                        ///< wanted of the case
    double core_time;                         ///< s, forecast
};

/// Half-widths that learning wants of single cases, by id, as they are kept in learn.json in the campaign's
/// folder. Together with the cases that it added (campaign/state/added_cases.hpp) they are all that it has to
/// remember. Empty when there is no such file. @throws core::InputError when the file is damaged
std::map<std::string, double> read_wanted_half_widths(std::filesystem::path const& folder);

/// Keeps them. @throws core::MissingError when the disk refuses
void write_wanted_half_widths(std::filesystem::path const& folder,
                              std::map<std::string, double> const& wanted);

/// Chooses what to simulate next for a surface over the domain of a campaign.
///
/// The domain is represented by 200 points of a Sobol sequence at which the trend has a mean speed. Each of
/// them is a candidate for a new case, and each case that is not as precise as its campaign file asks is a
/// candidate for an interval 0.7 times as wide, unless it was asked for less than it reached and so has all
/// the packings that it may have. The candidate is chosen that lowers the mean variance over
/// the domain and the variance at the worst place, each relative to what it is, most per forecast
/// core-second; then the next one, as if the first were known (its mean does not matter for the variance),
/// until the batch is full. (Active learning after D.A. Cohn, Neural Networks 9 (1996) 1071-1083, with
/// costs.)
class Learner {
  public:
    /// @param plan  its domain must have at least one number; @throws core::InputError when the campaign file
    /// has no [domain]
    Learner(campaign::Plan const& plan, scenario::CaseMaker const& maker, LearnGoal goal);
    /// Looks at these places alone instead of the whole domain, such as those at which a posterior lies.
    /// @param places  at least one at which the trend has a mean speed; @throws core::InputError when there
    /// is none
    void concentrate_on(std::vector<atlas::Place> const& places);

    /// Of the surface.
    std::vector<atlas::SurfaceInput> const& inputs() const { return points_.inputs; }
    /// Half-width that is wanted of a case at first: that of the surface, or of the campaign file if it is
    /// wider.
    double first_half_width(scenario::Scenario const& scenario) const;
    /// Looks at the results. @throws core::InputError when there are too few for a surface
    LearnStatus look();
    /// Whether the half-width and the coverage are as asked, and rest on enough points.
    static bool has_reached(LearnStatus const& status, LearnGoal const& goal);
    /// The next batch, after look(); empty when nothing helps or the budget does not allow a step.
    std::vector<LearnStep> choose() const;

  private:
    struct DomainPoint {
        atlas::Place place;
        double theory;
    };
    /// What a step would bring, for comparing candidates.
    struct Candidate {
        atlas::SurfacePoint point;  ///< as if it were known already
        std::string case_id;        ///< of a case that goes on
        double wanted;              ///< half-width of the case
        double core_time;           ///< s
        double worth = 0;           ///< reduction of the relative variances per core-second
    };
    std::vector<Candidate> candidates() const;
    std::vector<DomainPoint> make_domain() const;
    DomainCertainty certainty(atlas::Surface const& surface) const;

    campaign::Plan const& plan_;
    scenario::CaseMaker const& maker_;
    LearnGoal goal_;
    CampaignPoints points_;
    CampaignTrend trend_;
    std::vector<DomainPoint> domain_;
    std::map<std::string, double> core_times_;  ///< s, of the cases with a result, by id
    std::map<std::string, double> wanted_;      ///< half-widths that were asked of cases, by id
    std::optional<atlas::Surface> surface_;
};

}  // namespace vibrotrough::learn
