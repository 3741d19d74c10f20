#pragma once

#include "core/atomic_file.hpp"

#include <array>
#include <filesystem>
#include <span>
#include <vector>

namespace vibrotrough::measure {

/// Where the centre of mass of one material is at the end of cycles 0 ... n.
struct MaterialSeries {
    std::vector<double> x;  ///< m, along the trough
    std::vector<double> z;  ///< m, above the position of the floor at rest
};

/// What came, stayed and went in an open trough until, at or since the end of cycles 0 ... n (n + 1 values).
struct OpenSeries {
    std::vector<double> fed, fed_mass;    ///< grains and kg, all that were fed until then
    std::vector<double> left, left_mass;  ///< grains and kg that left in the cycle
    std::vector<double> held, held_mass;  ///< grains and kg in the trough
    std::vector<double> window_mass;      ///< kg, in the window, mean over the cycle
    std::vector<double> passed = {};      ///< grains that passed a screen in the cycle; none of other troughs
    std::vector<double> passed_mass = {};  ///< kg, of these grains
    /// Grains of each size of a screen at the end of the cycle, with those that left and passed in it.
    std::vector<std::vector<double>> of_size = {};

    /// All lists of a value for each cycle.
    std::vector<std::vector<double>*> lists();
};

/// How many materials a layer can have.
inline constexpr int most_materials = 4;

/// The results that the run of one packing wrote for each cycle. At the end of every cycle the trough is back
/// at its initial position, so that the displacement of the centre of mass is its displacement relative to
/// the trough.
struct CycleSeries {
    // Centre of mass at the end of cycles 0 ... n (n + 1 values).
    std::vector<double> x;   ///< m, along the trough
    std::vector<double> z;   ///< m, above the position of the floor at rest
    std::vector<double> vz;  ///< m/s, normal to the trough
    // Means over the steps of cycles 1 ... n.
    std::vector<double> mean_velocity;     ///< m/s, of the centre of mass along the trough
    std::vector<double> normal_force;      ///< N, of the layer on the trough, positive when pressing
    std::vector<double> tangential_force;  ///< N, of the layer on the trough, along x
    std::vector<double> flight_fraction;   ///< fraction of the steps without contact with the trough

    /// Of each material of a mixture, that of [grains] first; empty for the others and without a mixture.
    std::array<MaterialSeries, most_materials> materials{};
    OpenSeries open = {};  ///< empty but of an open trough

    /// Number of whole cycles n.
    int cycles() const { return static_cast<int>(normal_force.size()); }
};

/// cycles.csv, which for 200,000 cycles of fifty columns has 256 MB: a larger one is not read.
/// @throws MissingError if the file does not exist, or is larger
core::TextFile cycles_text(std::filesystem::path const& path);

/// Reads cycles.csv as written by the deck. A last line without a line end is left out, because the engine
/// may still be writing it.
/// @throws InputError naming file and line when a line is damaged, or a cycle or grains are missing
/// @throws MissingError if the file does not exist
/// @param materials  how many materials the layer has; with one there are no columns of materials
CycleSeries read_cycles(std::filesystem::path const& path, int steps_per_cycle, int grains,
                        int materials = 1);

/// The same for a file that has already been read. @throws InputError
CycleSeries parse_cycles(core::TextFile const& file, int steps_per_cycle, int grains, int materials = 1);

/// The same of an open trough, in which the number of grains is not the same in all lines. Its mean velocity
/// is that of the grains in the window. @throws InputError
/// @param sizes  of the grains on a screen; none when grains leave only at one place
CycleSeries parse_open_cycles(core::TextFile const& file, int steps_per_cycle, int sizes = 0);

/// The first `cycles` cycles of a series that has at least that many.
CycleSeries first_cycles(CycleSeries const& series, int cycles);

/// Whether no number of the series is NaN or infinite.
bool is_finite(CycleSeries const& series);

/// The largest difference in any cycle between the two mean speeds that the engine tells: the displacement of
/// the centre of mass over the duration of the cycle, and the mean of its velocity over the steps, m/s.
/// @param durations  of the cycles, s
double difference_of_speeds(CycleSeries const& series, std::span<double const> durations);

/// Up to so many lengths of the periodic box the engine surely knows how far a layer has come. It counts in
/// ten bits how often a grain has crossed the box: after 511 times it goes on at -512, and the centre of mass
/// jumps back, by 1024 lengths when all grains have. The fastest grains are first.
inline constexpr double surely_counted = 256;

/// The series without these jumps: from that distance on, the displacement in a cycle is that of the mean
/// velocity where the two differ by more.
/// @param box_length  m
/// @param durations   of the cycles, s
/// @param tolerance   m/s, of difference_of_speeds()
CycleSeries without_jumps(CycleSeries series, double box_length, std::span<double const> durations,
                          double tolerance);

/// The weight of the layer from the momentum balance over all cycles, N: the mean force on the trough minus
/// the change of the layer's momentum per time, W = mean(F_z) - m (v_z(n) - v_z(0)) / (n T). It is exact up
/// to the integrator, so that it shows whether the measured force on the trough includes every force that
/// acted on the layer.
/// @param mass    kg, of the layer
/// @param period  s, of a cycle
double weight_by_momentum(CycleSeries const& series, double mass, double period);

/// The same for cycles of different durations, s.
double weight_by_momentum(CycleSeries const& series, double mass, std::span<double const> durations);

}  // namespace vibrotrough::measure
