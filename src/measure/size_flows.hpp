#pragma once

#include "measure/screening.hpp"

#include <optional>
#include <string>
#include <vector>

/// @file
/// What comes, stays, passes and leaves a screen that is fed, by size.

namespace vibrotrough::measure {

/// Reads left.STEP.dump of a packing on a screen: the sizes of the grains that left over the edge, as
/// parse_passed(). @throws InputError naming the file when it is damaged
std::vector<PassedGrain> parse_left_sizes(std::vector<core::TextFile> const& files, int steps_per_cycle);

/// The grains of one size at the ends of cycles 0 ... n (n + 1 values).
struct SizeFlow {
    double diameter;                   ///< m
    double mass;                       ///< kg, of one grain
    std::vector<double> held;          ///< grains on the screen
    std::vector<double> left, passed;  ///< grains that left over the edge and passed the screen in the cycle
    std::vector<double> fed;  ///< grains that were fed until then: what is held, left and passed, less
                              ///< what was there at first
};

/// The flows of each size, from the smallest. Grains of other sizes are left out.
/// @param sizes  in the order of series.open.of_size
std::vector<SizeFlow> size_flows(CycleSeries const& series, std::vector<PassedGrain> const& left,
                                 std::vector<PassedGrain> const& passed,
                                 std::vector<ScreenedSize> const& sizes);

/// Why the grains do not add up size by size. At the end of every cycle those that left and passed are as
/// many as the engine counted; those that are held have its number and its mass, to a millionth of a grain;
/// and those that were fed, which follow from the others, have the number and the mass that the engine fed,
/// of no size fewer than in the cycle before. None when all this holds.
std::optional<std::string> flow_imbalance(CycleSeries const& series, std::vector<SizeFlow> const& flows);

/// Measures a packing, of whose grains the balance is known to hold: of each size how many left and passed in
/// the cycles that count, and what follows from these flows.
/// @param opening  m; smaller grains are undersize
/// @param from,to  the cycles after number `from` up to number `to` count
/// @param period   s, of a cycle
Screening screening_of_flows(std::vector<SizeFlow> const& flows, double opening, int from, int to,
                             double period);

}  // namespace vibrotrough::measure
