#pragma once

#include "core/atomic_file.hpp"

#include <optional>
#include <string>
#include <vector>

/// @file
/// The wear of the trough by LIGGGHTS' form of Finnie's law of erosion. For a contact with force F and
/// relative velocity v between the centre of the grain and the trough, at the angle g to the surface, it adds
///
///     dw = 2 |v| f(g) |F| dt / A   while the grain approaches,   f(g) = sin 2g - 3 sin^2 g   if tan g < 1/3,
///                                                                      cos^2(g) / 3          otherwise
///
/// to the wear of the triangle with the area A (doc/finnie-wear.pdf of LIGGGHTS 3.8, Eqs. 4.17 to 4.23; I.
/// Finnie, Wear 3 (1960) 87-103). w is an energy per area; times Finnie's constant of the materials, 1/Pa, it
/// is the depth that is worn off. The speed is that of the centre: the spin of the grain is not in it.

namespace vibrotrough::measure {

/// The wear of each triangle of the trough at one moment, in the order of trough.stl.
struct WearSnapshot {
    std::vector<double> x, y, z;  ///< m, centre of the triangle
    std::vector<double> area;     ///< m^2
    std::vector<double> wear;     ///< J/m^2, since the grains were poured in

    std::size_t triangles() const { return wear.size(); }  ///< number of triangles
};

/// The name of the file that the engine writes at a step.
std::string wear_file(long step);

/// Reads such a file, VTK's legacy text format. None when the engine has not finished writing it.
/// @throws InputError naming the file when it is damaged
std::optional<WearSnapshot> parse_wear(core::TextFile const& file);

/// The wear of the trough in one packing; empty when it was not asked for.
struct Wear {
    std::optional<double> rate;  ///< W/m^2, wear per time, mean over the surface
    /// J/(kg m), wear of the whole surface over the mass that was conveyed times its way; none when nothing
    /// was conveyed forwards
    std::optional<double> per_conveyed;
    std::vector<double> x, y, z;         ///< m, centre of each triangle
    std::vector<double> area;            ///< m^2, of each triangle
    std::vector<double> triangle_rates;  ///< W/m^2, of each triangle
    /// J/m^2, of each triangle at the end of cycle 0 ... n. Only the rates are kept in result.h5.
    std::vector<std::vector<double>> history;
};

/// Takes the snapshots at the end of cycle 0 ... n, whose rates are not known yet.
/// @throws InputError when they are not of the same trough
Wear wear_of(std::vector<WearSnapshot> snapshots);

/// Finds the rates from the end of cycle `from` to that of `to`.
/// @param time      s, between them
/// @param conveyed  kg m, mass that was conveyed between them times its way
void add_rates(Wear& wear, int from, int to, double time, double conveyed);

}  // namespace vibrotrough::measure
