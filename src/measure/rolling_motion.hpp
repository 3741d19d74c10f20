#pragma once

#include "core/atomic_file.hpp"
#include "measure/phase_series.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace vibrotrough::measure {

/// What measure.rolling adds to the results of a packing: the contacts at the floor within the cycle. Line i
/// = 0, 1 ... belongs to line 3 (i + 1) - 1 of phases.csv, so that each hundredth of the cycle is reached
/// once in three cycles. All values are instantaneous sums over grains; torques are about y, forces act on
/// the grains.
struct RollingSeries {
    static constexpr int stride = 3;  ///< lines of phases.csv for each line

    std::vector<double> loaded;        ///< contacts with the floor that carry a normal force
    std::vector<double> sliding;       ///< of these, contacts whose friction is mu times their normal force
    std::vector<double> friction;      ///< N, sum of the sizes of their tangential forces
    std::vector<double> torque;        ///< N m, all torques on the grains that touch the floor
    std::vector<double> contacts;      ///< contacts of these grains with other grains
    std::vector<double> all_contacts;  ///< contacts with other grains of all grains: two for each contact
    /// Grains with their centre in the first and in the second diameter above the base of the layer, which is
    /// the floor or the lowest grain, whichever is higher; m/s, sums of their v_x and omega_y R.
    std::vector<double> first, first_vx, first_spin, second, second_vx, second_spin;
    /// m^3, volume of grains below the first and below the second diameter.
    std::vector<double> first_volume, second_volume;
    std::vector<double> floor_x, floor_z;  ///< N, force of the floor on the grains
    std::vector<double> floor_torque;      ///< N m, torque of the floor on the grains

    /// Number of lines.
    std::size_t lines() const { return loaded.size(); }
};

/// What the analysis must be told.
struct RollingFacts {
    double grains;  ///< of the layer
    double slice;   ///< m^3, volume of one diameter of the box: length times width times d
    int discarded;  ///< cycles at the beginning to leave out
    int used;       ///< the last cycle to use
    std::vector<double> trough_velocity;  ///< m/s, along x at each of the 100 phases
};

/// Mean curves over one cycle, 100 values, over the cycles kept; value j is at phase 2 pi (j + 1) / 100.
/// Means over grains or contacts have a gap, NaN, where there never was one, and all but the first four where
/// no line of rolling.csv reached the phase. Velocities along the trough are relative to it.
struct RollingCurves {
    std::vector<double> phase;           ///< rad
    std::vector<double> floor_grains;    ///< number of grains that touch the floor
    std::vector<double> floor_velocity;  ///< m/s, theirs along the trough
    std::vector<double> floor_spin;      ///< m/s, their omega_y R, positive when they roll forwards
    std::vector<double> floor_slip;      ///< m/s, of their surface on the floor: floor_velocity - floor_spin
    /// Number of grains whose centre is in the first diameter above the base of the layer, also in flight;
    /// m/s.
    std::vector<double> first_grains, first_velocity, first_spin;
    std::vector<double> second_grains, second_velocity, second_spin;  ///< the same of the second diameter
    std::vector<double> floor_contacts;  ///< number of contacts with the floor that carry a load
    std::vector<double> sliding_share;   ///< share of these that slide
    std::vector<double> normal_force, tangential_force;  ///< N, of the layer on the floor, as in PhaseCurves
    std::vector<double> friction;                        ///< N, sum of the sizes of the tangential forces
    std::vector<double> floor_torque;                    ///< N m, of the floor on the grains that touch it
    std::vector<double> grain_torque;                    ///< N m, of the other grains on these
    std::vector<double> contacts_per_floor_grain;  ///< with other grains, of the grains that touch the floor
    std::vector<double> contacts_per_grain;        ///< with other grains and the floor, of all grains
    std::vector<double> first_fraction, second_fraction;  ///< solid fraction of the first and second diameter
    /// Mean over the cycle of contacts_per_grain, where it is known; none without lines.
    std::optional<double> coordination_number;
};

/// Reads rolling.csv as written by the deck. A last line without a line end is left out.
/// @param steps_per_cycle  a multiple of 100
/// @throws InputError naming file and line when a line is damaged or missing
RollingSeries parse_rolling(core::TextFile const& file, int steps_per_cycle);

/// The mean curves.
/// @param phases  of the same run
/// @throws InputError when one of the series ends before the last cycle that is used
RollingCurves rolling_curves(RollingSeries const& series, PhaseSeries const& phases,
                             RollingFacts const& facts);

}  // namespace vibrotrough::measure
