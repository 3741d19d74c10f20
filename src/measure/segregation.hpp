#pragma once

#include "measure/cycle_series.hpp"

#include <span>
#include <vector>

/// @file
/// How the materials of a mixture separate and move past each other.

namespace vibrotrough::measure {

/// The segregation index of a material at the end of cycles 0 ... n,
///
///     S = (z - z_others) / (H / 2),
///
/// with the height z of its centre of mass, that of the other materials together, and the height H of the
/// layer at rest. In a layer of one solid fraction that has separated completely the centres of mass of the
/// upper and the lower part are H / 2 apart, whatever the shares are: S is 1 when the material is on top of
/// all others, -1 when it lies below them, and 0 when the layer is mixed.
/// @param materials  of all materials, with the same number of cycles
/// @param masses     of all materials, in any unit
/// @param which      index of the material
/// @param height     H, m, above 0
std::vector<double> segregation_index(std::span<MaterialSeries const> materials,
                                      std::span<double const> masses, std::size_t which, double height);

/// The number of cycles at the end of a run over which its last segregation index is the mean: a tenth of
/// all, at least one.
int last_cycles(int cycles);

/// The velocity efficiency of a material between the end of cycle `from` and the last one: its displacement
/// over 2 pi r cos(beta) per cycle. NaN when there is no cycle.
/// @param amplitude_x  r cos(beta), m
double material_efficiency(MaterialSeries const& material, int from, double amplitude_x);

}  // namespace vibrotrough::measure
