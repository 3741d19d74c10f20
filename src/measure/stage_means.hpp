#pragma once

#include <vector>

/// @file
/// What the packings of a case say about the stages of its drive: how fast the layer is in the end of each
/// stage, and how it gets there.

namespace vibrotrough::measure {

/// The cycles of one stage.
struct StageCycles {
    int first;   ///< number of cycles before it
    int ramp;    ///< cycles of its ramp
    int cycles;  ///< with those of the ramp
};

/// The mean velocity of the layer along the trough in each cycle of each packing, m/s, and the durations of
/// the cycles, s. All packings have all cycles.
struct StagedVelocities {
    std::vector<double> durations;              ///< s, of each cycle
    std::vector<std::vector<double>> packings;  ///< m/s, of each packing in each cycle
};

/// A number of the ensemble of packings. Its values are those of the packings; where the number belongs to
/// the ensemble and not to a packing (time_to_speed) they are its pseudo-values: N t - (N - 1) t_i, with the
/// number t_i of the packings without the i-th (jackknife, Efron & Stein, Annals of Statistics 9, 1981,
/// 586-596). NaN where there is no value.
struct EnsembleNumber {
    std::vector<double> values;                  ///< of the packings
    double mean() const;                         ///< of the values
    double half_width(double confidence) const;  ///< Student's t over the values; NaN with fewer than two
};

/// What is measured in one stage. SI units.
struct StageMeans {
    EnsembleNumber speed;          ///< mean velocity in the second half of the cycles behind the ramp
    EnsembleNumber change;         ///< second half of those cycles less the first half: is the speed steady?
    EnsembleNumber distance;       ///< displacement of the layer along the trough in the stage
    EnsembleNumber time_to_speed;  ///< see time_to_speed()
};

/// How many cycles at the end of a stage give its speed: half of those behind its ramp, at least one.
int cycles_at_speed(StageCycles const& stage);

/// Time from the start of a stage until the mean of the packings has gone 95 % of the way from the speed
/// before to the speed at its end, s. Velocities count at the middle of their cycle and are interpolated.
/// NaN when the speed never gets there, or the stage has no cycles behind its ramp.
/// @param velocity  in each cycle of the run, mean over the packings
/// @param before    speed before the stage, m/s
double time_to_speed(StageCycles const& stage, std::vector<double> const& velocity,
                     std::vector<double> const& durations, double before);

/// All stages. The time to the speed is left out (NaN) where the two speeds differ by less than the sum of
/// the half-widths of their intervals.
std::vector<StageMeans> measure_stages(std::vector<StageCycles> const& stages,
                                       StagedVelocities const& velocities, double confidence);

}  // namespace vibrotrough::measure
