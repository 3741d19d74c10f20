#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::view {

/// All grains at one step, in the order of the dump. The engine writes six digits, so floats lose nothing.
struct GrainFrame {
    long step = 0;                ///< time step of the engine
    std::array<double, 6> box{};  ///< m, low and high of x, y and z
    std::vector<int> id;          ///< number of each grain
    std::vector<float> position;  ///< m, x y z of each grain
    std::vector<float> velocity;  ///< m/s, x y z of each grain, in the frame of the ground
    std::vector<float> radius;    ///< m

    /// Number of grains.
    std::size_t grains() const { return id.size(); }
};

/// Whether a dump was whole.
enum class DumpState {
    complete,    ///< all grains were read
    unfinished,  ///< the file ends early: the engine is writing it or was stopped
};

/// Reads LIGGGHTS dumps (`dump custom` with at least id x y z vx vy vz radius, in any order), keeping its
/// memory from one to the next.
class DumpReader {
  public:
    /// @throws InputError naming file and line when the text is no dump, a column is missing or a value is no
    /// number
    /// @throws MissingError when the file cannot be read
    DumpState read(std::filesystem::path const& path, GrainFrame& frame);

  private:
    std::string text_;
};

}  // namespace vibrotrough::view
