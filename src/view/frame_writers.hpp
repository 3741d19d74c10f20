#pragma once

#include "view/colour_scales.hpp"
#include "view/contact_reader.hpp"
#include "view/dump_reader.hpp"
#include "view/frames.hpp"
#include "view/scene.hpp"
#include "view/trough_motion.hpp"

#include <array>
#include <optional>
#include <vector>

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

/// Writers for the objects of a frame as .vtp files.
namespace vibrotrough::view {

/// Adds a number as field data.
void set_number(vtkPolyData& data, char const* name, double number);

/// Adds TimeValue (s), cycle (whole cycles since t = 0) and vibration_phase (deg, 0 to 360) as field data; of
/// a drive with stages also stage (from 1).
void set_time(vtkPolyData& data, FrameSource const& source, double time);

/// Writes the grains of one frame after another and reuses its memory.
class GrainWriter {
  public:
    /// `source` must outlive the writer.
    explicit GrainWriter(FrameSource const& source) : source_(source) {}
    /// Writes one frame at `time` (s); `surface` is the height of the trough's surface, m.
    /// @throws MissingError when the disk refuses
    void write(std::filesystem::path const& path, GrainFrame& frame, double surface, double time);

    /// Velocities of the grains in the last frame written: m/s, x y z of each grain, relative to the trough.
    std::vector<float> const& relative_velocity() const { return relative_; }
    /// m/s, mean velocity of the layer along the trough in the last frame written, relative to the ground.
    double mean_velocity() const { return mean_velocity_; }
    /// How far the values of all frames written so far reach.
    ColourScales const& scales() const { return scales_; }
    /// The space in which the grains of all frames written so far were; nothing before the first grain.
    std::optional<GrainSpace> const& space() const { return space_; }

  private:
    FrameSource const& source_;
    std::optional<GrainSpace> space_;
    std::vector<float> relative_, from_mean_, turns_, height_;
    double mean_velocity_ = 0;
    ColourScales scales_;
    vtkNew<vtkPolyData> data_;
};

/// Writes the displaced trough, or its walls, of one frame after another. Triangles of several meshes have
/// the number of theirs, `part`.
class TroughWriter {
  public:
    /// @param source  must outlive the writer
    /// @param meshes  STL files of what moves, at rest
    TroughWriter(FrameSource const& source, std::vector<std::filesystem::path> const& meshes);
    /// Writes the trough at `time` (s).
    /// @throws MissingError when the disk refuses
    void write(std::filesystem::path const& path, TroughPosition const& position, double time);

    /// m, lower and upper bounds of x, y and z at rest.
    std::array<double, 6> bounds() const;

  private:
    FrameSource const& source_;
    vtkSmartPointer<vtkPolyData> rest_;
    std::vector<int> part_;  ///< of each triangle: the number of its mesh, from 0
    vtkNew<vtkPolyData> moved_;
};

/// Writes the contacts of one frame: a line for each, from the centre of the first grain to that of the
/// second or to the point on the trough, with the forces. @throws MissingError when the disk refuses
void write_contacts(std::filesystem::path const& path, FrameSource const& source, ContactFrame& frame,
                    double time);

/// Writes the profile over the height of the layer for one frame: a point per slab, joined by a line;
/// `surface` is the height of the trough's surface, m.
void write_profile(std::filesystem::path const& path, FrameSource const& source, GrainFrame const& frame,
                   std::vector<float> const& relative_velocity, double surface, double time);

}  // namespace vibrotrough::view
