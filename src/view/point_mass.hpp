#pragma once

#include "view/frames.hpp"

#include <array>
#include <string_view>

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace vibrotrough::view {

/// Where the theory's point mass is at one time, SI, in the frame of the ground.
struct PointMassState {
    theory::PhaseKind phase;  ///< what the mass does
    double x;                 ///< m, displacement along the trough since t = 0, of mass and trough together
    double gap;               ///< m, above the trough's surface
    std::array<double, 3> velocity;           ///< m/s, x y z
    std::array<double, 3> relative_velocity;  ///< against the trough, m/s
};

/// "rests", "slides forwards", "slides backwards" or "flies".
std::string_view in_words(theory::PhaseKind phase);

/// Evaluates the periodic motion at omega t, in step with the trough.
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
    /// @param trough_bounds  m, low and high of x, y and z of the trough at rest
    explicit PointMassBlock(std::array<double, 6> const& trough_bounds);

    /// The cube at one frame; `trough_z` is the trough's displacement from rest, m.
    vtkSmartPointer<vtkPolyData> at(PointMassState const& state, double trough_z) const;

  private:
    std::array<double, 6> trough_;
    double edge_;
};

}  // namespace vibrotrough::view
