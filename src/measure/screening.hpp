#pragma once

#include "core/atomic_file.hpp"
#include "measure/cycle_series.hpp"

#include <optional>
#include <string>
#include <vector>

/// @file
/// What passes a screen and what stays on it, by size.

namespace vibrotrough::measure {

/// The grains of one size that were on the screen at first.
struct ScreenedSize {
    double diameter;  ///< m
    int number;       ///< of grains
    double mass;      ///< kg, of one grain
};

/// A grain that has passed the screen.
struct PassedGrain {
    int cycle;    ///< at whose end it was found below the screen, from 1
    long id;      ///< its number
    double size;  ///< m, its diameter
};

/// Reads passed.STEP.dump of a packing, as parse_cycle_dumps(). A grain that stays below the screen counts
/// once, in the cycle in which it was found first.
/// @throws InputError naming the file when it is damaged
std::vector<PassedGrain> parse_passed(std::vector<core::TextFile> const& files, int steps_per_cycle);

/// Why the grains that passed and those on the screen are not, size by size, those that were there at first:
/// at the end of every cycle the numbers, and the masses to a millionth of a grain, agree with what the
/// engine counted. None when they do.
std::optional<std::string> size_imbalance(CycleSeries const& series, std::vector<PassedGrain> const& passed,
                                          std::vector<ScreenedSize> const& sizes);

/// Whether a diameter in a file of the engine, which has six digits, is that of a size.
bool is_same_size(double diameter, double size);

/// The grains on a screen that is fed: one row for each size and the end of each cycle 0 ... n.
struct SizeTable {
    std::vector<double> diameter;      ///< m
    std::vector<double> cycle;         ///< number of the cycle
    std::vector<double> fed, held;     ///< grains that were fed until then, and that are on the screen
    std::vector<double> left, passed;  ///< grains that left over the edge and passed the screen in the cycle
};

/// What was measured in one packing on a screen. The lists have one value for each size, from the smallest.
/// With a feed they are of the grains that left over the edge or passed the screen in the cycles that count,
/// with a batch of the grains that were there at first.
struct Screening {
    std::vector<double> diameter;             ///< m
    std::vector<double> number;               ///< of grains
    std::vector<double> mass;                 ///< kg, of one grain
    std::vector<double> passed;               ///< number of these grains that passed
    std::vector<double> passed_cycle;         ///< of each grain that passed, in their order: the cycle
    std::vector<double> passed_diameter;      ///< m, of the same grains
    std::optional<double> efficiency = {};    ///< mass of undersize that passed over all of it
    std::optional<double> passed_share = {};  ///< mass that passed over all mass
    std::optional<double> undersize = {};     ///< mass share of undersize in what did not pass
    std::optional<double> cut_size = {};      ///< m, see cut_size()
    std::optional<double> distance = {};      ///< m, that the layer of a batch was conveyed
    std::optional<double> underflow = {};     ///< kg/s, that pass a screen with a feed
    SizeTable by_size = {};                   ///< of a screen with a feed
};

/// Measures a packing, of whose grains the balance is known to hold. Grains smaller than the opening are
/// undersize.
/// @param opening  m
/// @param period   s, of a cycle
Screening screening(CycleSeries const& series, std::vector<PassedGrain> const& passed,
                    std::vector<ScreenedSize> sizes, double opening, double period);

/// Share of the grains of a size that is still on the screen at the end of each cycle 0 ... n.
std::vector<double> share_curve(Screening const& screening, std::size_t size, int cycles);

/// Mass of undersize that passed until the end of each cycle 0 ... n over that at first; empty when there is
/// no undersize.
std::vector<double> efficiency_curve(Screening const& screening, double opening, int cycles);

/// The size of which half of the grains stay, m: between the largest size of which less than half stay and
/// the next larger one, along a straight line. All spheres as large as the opening stay. None when half or
/// more of every size stay, or less than half of the largest.
/// @param diameters  m, from the smallest
std::optional<double> cut_size(std::vector<double> const& diameters, std::vector<double> const& shares,
                               double opening);

/// The time until half of the grains of a size have passed, s, between the ends of two cycles along a
/// straight line. None when fewer have passed.
/// @param shares  share_curve() of the size
/// @param period  s, of a cycle
std::optional<double> half_time(std::vector<double> const& shares, double period);

}  // namespace vibrotrough::measure
