#pragma once

#include "learn/exciter.hpp"
#include "theory/drive.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// @file
/// What plants are built of: the tables of input_templates/plant, and a person's own of the same columns.

namespace vibrotrough::learn {

/// A common bulk material, as far as it is usually known.
struct BulkMaterial {
    std::string name;                ///< by which an option chooses it
    theory::Range bulk_density;      ///< kg/m^3
    theory::Range friction;          ///< on steel
    theory::Range rolling_friction;  ///< of the grains
    theory::Range size;              ///< m
    std::string kind;                ///< a word of grain_kinds(); empty for grains that the models know
    std::string source;              ///< of the ranges
};

/// @throws core::CsvError that names line and column
std::vector<BulkMaterial> read_materials(std::string_view text, std::string const& file);

/// What a kind of drive builds, where nobody asks for anything else.
struct DriveKind {
    std::string name;       ///< unbalance motors, crank, magnet
    theory::Range stroke;   ///< m
    theory::Range rpm;      ///< 1/min
    double machine_number;  ///< largest K
    std::string source;     ///< of the limits

    /// Whether such a drive is one of this kind. @param drive  of a machine
    bool builds(theory::Drive const& drive) const;
};

/// @throws core::CsvError that names line and column
std::vector<DriveKind> read_drives(std::string_view text, std::string const& file);

/// The motors of a table, at their synchronous speed. @throws core::CsvError that names line and column, and
/// when the force of a motor is not its static moment times omega^2, within five percent
std::vector<Motor> read_motors(std::string_view text, std::string const& file);

/// A kind of grains that no model here knows.
struct GrainKind {
    std::string_view name;    ///< by which an option chooses it
    bool is_refused;          ///< there is no answer; else one without a probability
    std::string_view reason;  ///< without a full stop
};

/// powder, moist, flakes, rods and mix.
std::vector<GrainKind> const& grain_kinds();

/// m: of smaller grains the air between them decides. Below it they are a powder.
inline constexpr double largest_powder = 0.0002;
/// The largest grains of a mix over the smallest, up to which it counts as of one size: as widely as the
/// sizes of the atlas' layers may be spread.
inline constexpr double widest_size_ratio = 1.5;

}  // namespace vibrotrough::learn
