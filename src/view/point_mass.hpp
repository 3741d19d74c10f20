#pragma once

#include "view/frames.hpp"

#include <array>
#include <string_view>

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace vibrotrough::view {

/// The state of the theory's point mass at one time, in SI units, relative to the ground.
struct PointMassState {
    theory::PhaseKind phase;  ///< what the mass does
    double x;    ///< m, displacement along the trough since t = 0, including the motion of the trough
    double gap;  ///< m, height above the trough's surface
    std::array<double, 3> velocity;           ///< m/s, x y z
    std::array<double, 3> relative_velocity;  ///< m/s, relative to the trough
};

/// "rests", "slides forwards", "slides backwards" or "flies".
std::string_view in_words(theory::PhaseKind phase);

/// Evaluates the periodic motion at omega t, in phase with the trough.
class PointMassMotion {
  public:
    /// Both must outlive this object.
    PointMassMotion(FrameSource const& source, TheoryMotion const& theory);
    /// The state at `time` (s).
    PointMassState at(double time) const;

  private:
    FrameSource const& source_;
    TheoryMotion const& theory_;
    double displacement_at_start_;
};

/// The point mass drawn as a cube beside the trough, wrapped along it like the grains.
class PointMassBlock {
  public:
    /// @param trough_bounds  m, lower and upper bounds of x, y and z of the trough at rest
    explicit PointMassBlock(std::array<double, 6> const& trough_bounds);

    /// The cube in one frame; `trough_z` is the displacement of the trough from rest, m, and `layer_vx` the
    /// mean velocity of the layer along the trough, m/s relative to the ground.
    vtkSmartPointer<vtkPolyData> at(PointMassState const& state, double trough_z, double layer_vx) const;

  private:
    std::array<double, 6> trough_;
    double edge_;
};

}  // namespace vibrotrough::view
