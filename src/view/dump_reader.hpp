#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::view {

/// A table that the engine wrote at one step (`dump custom` or `dump local`).
struct EngineDump {
    std::filesystem::path path;        ///< where it was read
    long step = 0;                     ///< time step of the engine
    std::array<double, 6> box{};       ///< m, lower and upper bounds of x, y and z
    std::vector<std::string> columns;  ///< their names
    std::vector<double> values;        ///< row by row

    std::size_t rows() const { return values.size() / columns.size(); }  ///< number of rows
    /// Whether there is a column of this name.
    bool has(std::string_view name) const;
    /// Its values. @throws InputError naming file and line unless there is exactly one
    std::vector<double> column(std::string_view name) const;
};

/// Reads a dump.
/// @param item  what its rows are: "ATOMS" or "ENTRIES"
/// @returns nothing when the file is incomplete: the engine is still writing it or was stopped
/// @throws InputError naming file and line when the text is not a dump or a value is not a number
/// @throws MissingError when the file cannot be read
std::optional<EngineDump> read_dump(std::filesystem::path const& path, std::string_view item);

/// All grains at one step, in the order of the dump. The engine writes six digits, for which single precision
/// is sufficient.
struct GrainFrame {
    long step = 0;                ///< time step of the engine
    std::array<double, 6> box{};  ///< m, lower and upper bounds of x, y and z
    std::vector<int> id;          ///< number of each grain
    std::vector<float> position;  ///< m, x y z of each grain
    std::vector<float> velocity;  ///< m/s, x y z of each grain, relative to the ground
    std::vector<float> radius;    ///< m
    std::vector<int> type;        ///< of the engine, one for each material; empty when the dump has none
    std::vector<float> spin;      ///< rad/s, x y z of each grain; empty when the dump does not contain it

    /// Number of grains.
    std::size_t grains() const { return id.size(); }
};

/// Reads the grains of a dump with at least id x y z vx vy vz radius, in any order, and perhaps type and
/// omegax omegay omegaz. @returns and throws as read_dump()
std::optional<GrainFrame> read_grains(std::filesystem::path const& path);

}  // namespace vibrotrough::view
