#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::view {

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

/// Whether a dump was whole.
enum class DumpState {
    complete,    ///< all grains were read
    unfinished,  ///< the file is incomplete: the engine is still writing it or was stopped
};

/// Reads LIGGGHTS dumps (`dump custom` with at least id x y z vx vy vz radius, in any order, and perhaps
/// type and omegax omegay omegaz) and reuses its memory from one file to the next.
class DumpReader {
  public:
    /// @throws InputError naming file and line when the text is not a dump, a column is missing or a value is
    /// not a number
    /// @throws MissingError when the file cannot be read
    DumpState read(std::filesystem::path const& path, GrainFrame& frame);

  private:
    std::string text_;
};

}  // namespace vibrotrough::view
