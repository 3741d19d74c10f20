#pragma once

#include "learn/layer_search.hpp"
#include "learn/risk_design.hpp"
#include "learn/way_out.hpp"

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <vector>

// Internal to the design with risk (risk_design.cpp).
namespace vibrotrough::learn {

/// What the errors of the settings leave open of a speed: standard deviations.
struct SettingSpread {
    double amplitude = 0;        ///< m/s, by the stroke
    double vibration_angle = 0;  ///< m/s
    double bulk_density = 0;     ///< of the mass flow, relative
};

/// The conveying speeds of a drive: a mixture of normal distributions, at least one per part of the friction.
/// They are those that give the mass flow with the mean bulk density, whose error counts as one of the speed.
struct SpeedDistribution {
    std::vector<double> shares, means, sds;  ///< -, m/s, m/s
    SettingSpread settings = {};             ///< at the median of the friction; a part of `sds`

    /// Probability of a speed above one. @param speed  m/s
    double probability_above(double speed) const;
    /// The speed that is exceeded with a probability, m/s.
    double exceeded_with(double probability) const;
    double sd() const;           ///< m/s, standard deviation
    double sd_of_means() const;  ///< m/s, of it what the parts differ in their means
    bool may_run_away() const;   ///< whether some part has no steady speed; `means` has -1000 m/s there
    /// The same without the bulk density, which changes the mass flow, and not the speed.
    SpeedDistribution of_speed_alone() const;
};

/// The layers that a design looks at, and what is known of each.
class RiskSearch {
  public:
    /// Which layers are looked at.
    enum class Layers {
        tested,  ///< those at which the error of every model is known
        all,
    };

    /// @param task   must live as long as the search
    /// @throws std::invalid_argument when the models know no machine within the limits
    RiskSearch(DesignTask const& task, Layers layers);

    /// By the many parts of the friction.
    SpeedDistribution speeds(DesignLayer const& layer, DesignModel const& model) const;
    /// m/s, reached with the task's confidence by all models; below zero when the material runs away. By the
    /// many parts of the friction.
    double sure_speed(DesignLayer const& layer) const;
    /// kg/s, that a layer carries with the task's confidence by all models.
    double sure_flow(DesignLayer const& layer) const;

    /// The layer that carries most at the task's confidence.
    std::optional<FoundLayer> strongest();
    /// The best layer by the task's objective of those that carry the mass flow.
    /// @param strongest  which carries it
    std::optional<FoundLayer> best_that_carries(FoundLayer const& strongest);
    /// m, the depth of the thinnest layer on a drive that carries the mass flow, in steps of 0.1 mm where the
    /// range of depths allows it; nothing where none carries it. @param known  m, a depth that may carry it
    std::optional<double> carrying_depth(theory::Drive const& drive, double known) const;
    /// By which machines with a layer of one depth are compared, when they carry the mass flow: larger is
    /// better.
    double merit(DesignLayer const& layer) const;

    /// A landing at some friction.
    struct Landing {
        double friction, speed;  ///< -, m/s
    };
    /// The hardest landing at any friction in the central 99.7 % of its distribution, from 65 of them and a
    /// search by Brent's method between those beside the worst.
    Landing worst_landing(theory::Drive const& drive) const;
    /// Whether a drive keeps every limit at every friction.
    bool keeps_limits(theory::Drive const& drive) const;

    DesignTask const& task() const { return task_; }           ///< of the design
    AllowedLayers const& allowed() const { return allowed_; }  ///< by limits and models

  private:
    using GoalOf = std::function<LayerGoal(Precision)>;

    double expected_speed(DesignLayer const& layer, Precision precision) const;
    double objective_at(DesignLayer const& layer, Precision precision) const;
    bool is_looked_at(DesignLayer const& layer) const;
    void add_limits(LayerGoal& goal) const;
    std::optional<FoundLayer> best(GoalOf const& goal, std::vector<std::vector<double>> const& starts);
    std::optional<FoundLayer> best_at_these_frictions(GoalOf const& goal,
                                                      std::vector<std::vector<double>> const& starts) const;
    void keep_landing_at(Landing const& landing);
    double per_depth_and_speed() const;

    DesignTask const& task_;
    Layers layers_;
    AllowedLayers allowed_;
    LayerSpace space_;
    std::vector<FrictionPart> few_, many_;  ///< of the friction
    double correction_ = 1;                 ///< of the sure speed by the few
    /// m/s, what the few say of the layers that were looked at, near and exact: each goal and each exchange
    /// begins with the same sample.
    mutable std::array<std::map<std::array<double, 5>, double>, 2> known_speeds_ = {};
    std::vector<double> landing_frictions_;  ///< at which the search keeps the landing speed
    double aim_ = 1;  ///< of the landing speed, relative to its limit; lowered when a friction repeats
};

}  // namespace vibrotrough::learn
