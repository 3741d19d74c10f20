#pragma once

#include "scenario/model/drive.hpp"
#include "theory/conveyor.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace vibrotrough::view {

/// The theory's periodic motion on the same drive, with its pieces, and its units of length.
struct TheoryMotion {
    theory::ConveyorMotion motion;  ///< in the units of the theory
    double length_x;                ///< m, its unit of length along the trough, r cos(beta)
    double length_z;                ///< m, its unit normal to it
    double phase_at_start = 0;      ///< rad, its time (an angle) at the drive's t = 0
};

/// Where one run's frames come from and what they need to be understood.
struct FrameSource {
    std::filesystem::path folder;  ///< holds frames.STEP.dump and frames.csv (step, trough x, trough z)
    std::filesystem::path trough;  ///< the STL of the trough at rest, m
    double time_step;              ///< s
    double angular_frequency;      ///< omega, rad/s
    scenario::DriveMotion
        drive;     ///< X(t) and Z(t); the trough's displacement at t is X(t) - X(0) and Z(t) - Z(0)
    double width;  ///< m, of the layer across the trough
    std::optional<TheoryMotion> point_mass = {};  ///< nothing when the theory has no periodic motion
    std::string caption;  ///< one line shown in the scene, without Greek (ParaView has none); may be empty
};

/// The files that an export wrote.
struct ExportedFrames {
    int frames = 0;                    ///< number of frames
    std::filesystem::path grains;      ///< grains.pvd
    std::filesystem::path trough;      ///< trough.pvd
    std::filesystem::path point_mass;  ///< point_mass.pvd: the theory's point mass as a block beside the
                                       ///< layer; without entries when it has no periodic motion
    std::filesystem::path profile;     ///< profile.pvd: velocity and solid fraction over height
    std::filesystem::path scene;       ///< view_case.py: `paraview --state=<scene>` opens all of it
};

/// Turns the engine's dumps into compressed inline .vtp files, one collection (.pvd) for each object, with
/// true times (s), and a ParaView scene, all under `target`. The collections are renewed while frames are
/// written, so an export that is stopped opens with the frames it has. One frame at a time is in memory.
///
/// A last frame that the engine had not finished writing is left out; no frame at all makes empty
/// collections.
///
/// @param progressed  is told about once a second; may be empty
/// @throws InputError naming file and line when a dump or frames.csv is damaged, when a frame in between is
/// missing, or
///         when the trough is not where the drive puts it
/// @throws MissingError when a file cannot be read or the disk refuses
ExportedFrames export_frames(FrameSource const& source, std::filesystem::path const& target,
                             std::function<void(int written, int all)> const& progressed = {});

}  // namespace vibrotrough::view
