#pragma once

#include "scenario/model/stage_motion.hpp"
#include "theory/conveyor.hpp"
#include "view/colour_scales.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vibrotrough::view {

/// The theory's periodic motion for the same drive, with its pieces and units of length.
struct TheoryMotion {
    theory::ConveyorMotion motion;  ///< in the units of the theory
    double length_x;                ///< m, unit of length along the trough, r cos(beta)
    double length_z;                ///< m, unit of length normal to the trough
    double phase_at_start = 0;      ///< rad, time of the motion (an angle) at t = 0 of the drive
};

/// The frames of one run and the data needed to interpret them.
struct FrameSource {
    std::filesystem::path folder;  ///< holds frames.STEP.dump and frames.csv (step, trough x, trough z), and
                                   ///< perhaps contacts.STEP.dump and trough_contacts.STEP.dump
    std::vector<std::filesystem::path> trough;      ///< the STL files of the trough at rest, m: its parts
    std::vector<std::filesystem::path> walls = {};  ///< those of its walls, which move with it; may be none
    double time_step;                               ///< s
    double angular_frequency;                       ///< omega, rad/s
    /// X(t) and Z(t); the displacement of the trough at t is X(t) - X(0) and Z(t) - Z(0).
    scenario::DriveMotion drive;
    double width;                                 ///< m, of the layer across the trough
    std::optional<TheoryMotion> point_mass = {};  ///< nothing when the theory has no periodic motion
    std::string caption;  ///< one line shown in the scene, without Greek letters (ParaView cannot show them);
                          ///< may be empty
    Colour colour = Colour::velocity;             ///< what the scene colours the grains by
    std::vector<scenario::DrivePart> parts = {};  ///< of a drive with stages, in place of `drive`
    int steps_per_cycle = 0;                      ///< of the engine, when there are parts
    /// Of a mixture: each material's type of the engine, with its name; none of other layers.
    std::vector<std::pair<int, std::string>> materials = {};

    /// The time of a step of the engine, s.
    double time_of(long step) const;
};

/// The files that an export wrote.
struct ExportedFrames {
    int frames = 0;                    ///< number of frames
    std::filesystem::path grains;      ///< grains.pvd
    std::filesystem::path trough;      ///< trough.pvd
    std::filesystem::path point_mass;  ///< point_mass.pvd: the theory's point mass as a block beside the
                                       ///< layer; empty if its motion is not periodic
    std::filesystem::path profile;     ///< profile.pvd: velocity and solid fraction over height
    std::filesystem::path walls;       ///< walls.pvd; empty if the trough has no walls of their own
    std::filesystem::path contacts;    ///< contacts.pvd; empty if the frames have no contacts
    std::filesystem::path scene;       ///< view_case.py: `paraview --state=<scene>` opens everything
};

/// Converts the engine's dumps into compressed inline .vtp files with one collection (.pvd) for each object,
/// with times in s, and a ParaView scene, all in the folder `target`. The collections are updated while
/// frames are written, so that an interrupted export can be opened with the frames written so far. Only one
/// frame at a time is in memory.
///
/// A last frame that the engine has not finished writing is left out. Without any frame the collections are
/// empty.
///
/// @param progressed  called about once a second with the number of frames written and of all frames; may be
/// empty
/// @throws InputError naming file and line when a dump or frames.csv is damaged, when a frame other than the
/// last is missing, or when the position of the trough does not agree with the drive
/// @throws MissingError when a file cannot be read or written
ExportedFrames export_frames(FrameSource const& source, std::filesystem::path const& target,
                             std::function<void(int written, int all)> const& progressed = {});

}  // namespace vibrotrough::view
