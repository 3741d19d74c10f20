#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

namespace vibrotrough::view {

/// The contacts between grains, and of grains with the trough, at one step.
struct ContactFrame {
    long step = 0;  ///< time step of the engine
    /// Numbers of the two grains, 0 instead of the second for the trough.
    std::vector<int> first, second;
    std::vector<float> start;  ///< m, x y z of the centre of the first grain
    /// m, x y z of the centre of the second grain nearest to it, which may be outside the periodic box, or of
    /// the point on the trough.
    std::vector<float> end;
    std::vector<float> normal_force;      ///< N, x y z, on the first grain
    std::vector<float> tangential_force;  ///< N, x y z, on the first grain
    std::vector<float> overlap;           ///< m

    /// Number of contacts.
    std::size_t contacts() const { return first.size(); }
};

/// Reads contacts.STEP.dump and trough_contacts.STEP.dump of a folder.
/// @param box  m, lower and upper bounds of x, y and z, from the grains' frame; x is periodic, and so is y
///             unless grains at its ends never touch each other
/// @returns nothing when a file is missing or incomplete, as while the engine is writing it
/// @throws InputError naming file and line when a file is not what the deck's dumps write
std::optional<ContactFrame> read_contacts(std::filesystem::path const& folder, long step,
                                          std::array<double, 6> const& box);

/// Whether the folder has contacts of any frame.
bool has_contacts(std::filesystem::path const& folder);

}  // namespace vibrotrough::view
