// Exports the sample's frames into a folder, for the tests that open it in ParaView.

#include "view/frames.hpp"

#include <cstdio>
#include <exception>
#include <numbers>

int main(int argc, char** argv) {
    using namespace vibrotrough::view;
    if (argc != 3) {
        std::fprintf(stderr, "usage: view_export_sample DUMPS FOLDER\n");
        return 2;
    }
    try {
        std::filesystem::path const dumps = argv[1];
        double constexpr time_step = 2.4493014e-5;
        ExportedFrames const exported =
            export_frames({.folder = dumps,
                           .trough = dumps / "trough.stl",
                           .time_step = time_step,
                           .angular_frequency = 2.0 * std::numbers::pi / (3000 * time_step),
                           .amplitude_x = 0.00536656,
                           .amplitude_z = 0.00268328,
                           .caption = "throw number 2, vibration angle 26.6°"},
                          argv[2]);
        std::printf("%d frames, %s\n", exported.frames, exported.scene.c_str());
        return 0;
    } catch (std::exception const& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
