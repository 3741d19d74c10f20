#pragma once

#include <filesystem>

namespace vibrotrough::view {

/// Where one run's frames come from and what they need to be understood.
struct FrameSource {
    std::filesystem::path folder;  ///< holds frames.<step>.dump and frames.csv (step, trough x, trough z)
    std::filesystem::path trough;  ///< the STL of the trough at rest
    double time_step;              ///< s
    double angular_frequency;      ///< omega, rad/s: the trough's velocity is that of A sin(omega t)
    double amplitude_x;            ///< m, r cos(beta)
    double amplitude_z;            ///< m, r sin(beta)
};

struct ExportedFrames {
    int frames;
    std::filesystem::path grains;  ///< grains.pvd
    std::filesystem::path trough;  ///< trough.pvd
};

/// Turns the engine's dumps into compressed inline .vtp files, one collection (.pvd) for the grains and one
/// for the trough, with true times, under `target`. A frame that the engine had not finished writing is left
/// out.
ExportedFrames export_frames(FrameSource const& source, std::filesystem::path const& target);

}  // namespace vibrotrough::view
