#pragma once

#include "theory/drive_search.hpp"

#include <numbers>
#include <string_view>

// Internal to this room.
namespace vibrotrough::learn {

inline constexpr double degree = std::numbers::pi / 180;  ///< rad

/// An input of a campaign that says how the machine is set, and its value at a drive in SI units.
struct MachineKey {
    std::string_view key;                   ///< path in the campaign file
    double (*value)(theory::Drive const&);  ///< at a drive
};

/// The machine key with this path, or nullptr.
MachineKey const* machine_key(std::string_view key);

}  // namespace vibrotrough::learn
