#pragma once

#include "theory/conveyor.hpp"

// Internal to this room.
namespace vibrotrough::theory::detail {

/// The weakest friction that a solver can follow, as a change of velocity per radian in omega r cos(beta): a
/// weaker one changes the velocity within a cycle by little more than rounding does, or less, and then any
/// motion seems periodic. With these the error of rounding is about 1e-7 and that of the limit is smaller.
constexpr double weakest_force = 5e-9;

/// The same problem with stronger forces along the trough where those of `input` are too weak to be followed.
/// The periodic motion that develops in the end depends on the ratios of the weak forces only (friction, drag
/// and the component of gravity along the trough), up to terms as small as they are: where their sum over a
/// cycle is zero, a multiple of it is zero, too. So all of them are multiplied by the same factor. A drag
/// that is lost in rounding beside friction is left out.
PointMass with_noticeable_forces(PointMass const& input);
/// @copydoc with_noticeable_forces(PointMass const&)
Conveyor with_noticeable_forces(Conveyor const& input);

}  // namespace vibrotrough::theory::detail
