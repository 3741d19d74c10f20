#pragma once

#include "scenario/reader/keys.hpp"
#include "theory/drive.hpp"
#include "theory/point_mass.hpp"

#include <numbers>
#include <string_view>

// Internal to this module.
namespace vibrotrough::learn {

inline constexpr double degree = std::numbers::pi / 180;  ///< rad

/// The key with this path if it says how the machine is set: amplitude, angles and speed of the drive, each
/// of which can be given by several keys. Otherwise nullptr.
scenario::Key const* machine_key(std::string_view path);

/// The point mass on a trough with this drive.
theory::PointMass point_of(theory::Drive const& drive, double friction);

/// The value of a machine key at a drive, in SI units.
double value_at(scenario::Key const& key, theory::Drive const& drive);

}  // namespace vibrotrough::learn
