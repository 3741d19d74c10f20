#pragma once

#include "learn/risk_design.hpp"

#include <optional>
#include <vector>

// Internal to the design with risk (risk_design.cpp).
namespace vibrotrough::learn {

/// The conveying speeds of a drive: a mixture of normal distributions, at least one per part of the friction.
struct SpeedDistribution {
    std::vector<double> shares, means, sds;  ///< -, m/s, m/s

    /// Probability of a speed above one. @param speed  m/s
    double probability_above(double speed) const;
    /// The speed that is exceeded with a probability, m/s.
    double exceeded_with(double probability) const;
    double sd() const;           ///< m/s, standard deviation
    double sd_of_means() const;  ///< m/s, of it what the parts differ in their means
};

/// What the errors of the settings leave open of a speed: standard deviations.
struct SettingSpread {
    double amplitude = 0;        ///< m/s, by the stroke
    double vibration_angle = 0;  ///< m/s
    double bulk_density = 0;     ///< of the mass flow, relative
};

/// The drives that a design looks at, and what is known of each.
class RiskSearch {
  public:
    /// @param task   must live as long as the search
    /// @param space  the drives that its limits allow
    RiskSearch(DesignTask const& task, theory::DriveSpace space);

    /// m/s, needed for the mass flow at the largest depth.
    double needed() const;
    /// By the many parts of the friction.
    /// @param depth  of the layer, in diameters of its grains, if it is known
    SpeedDistribution speeds(theory::Drive const& drive, DesignModel const& model,
                             std::optional<double> depth = {}) const;
    /// At the median of the friction.
    SettingSpread spread_of_settings(theory::Drive const& drive, DesignModel const& model) const;
    /// m/s, reached with the task's confidence by all models; below zero when the material runs away. By the
    /// many parts of the friction.
    double sure_speed(theory::Drive const& drive) const;
    /// The same by the few parts, by which best() searches; corrected by trust_at().
    double expected_sure_speed(theory::Drive const& drive) const;
    /// From now on the few parts give what the many do at this drive.
    void trust_at(theory::Drive const& drive);
    /// What is made as large as possible.
    double merit(theory::Drive const& drive, Objective objective) const;

    /// A landing at some friction.
    struct Landing {
        double friction, speed;  ///< -, m/s
    };
    /// The hardest landing at any friction in the central 99.7 % of its distribution, from 65 of them and a
    /// search by Brent's method between those beside the worst.
    Landing worst_landing(theory::Drive const& drive) const;
    /// From now on best() keeps the landing speed at this friction, too, where it was found to be `speed`.
    void keep_landing_at(double friction, double speed);
    /// Whether a drive keeps every limit at every friction. @param must_reach  also the mass flow
    bool keeps_limits(theory::Drive const& drive, bool must_reach) const;

    /// The best drive that keeps the limits at the frictions looked at so far.
    std::optional<theory::Drive> best(Objective objective, bool must_reach) const;

    DesignTask const& task() const { return task_; }            ///< of the design
    theory::DriveSpace const& space() const { return space_; }  ///< that the limits allow

  private:
    double sure_speed(theory::Drive const& drive, std::vector<FrictionPart> const& parts) const;

    DesignTask const& task_;
    theory::DriveSpace space_;
    std::vector<FrictionPart> few_, many_;   ///< of the friction
    double correction_ = 1;                  ///< of the sure speed by the few
    std::vector<double> landing_frictions_;  ///< at which best() keeps the landing speed
    double aim_ = 1;  ///< of the landing speed, relative to its limit; lowered when a friction repeats
};

}  // namespace vibrotrough::learn
